#include "protocol/cpp/json_bridges.h"

#include <algorithm>
#include <array>
#include <string>

#include "core/bridges/arkit.h"
#include "core/bridges/head_turn.h"
#include "core/bridges/oculus.h"

namespace semblante {
namespace {

constexpr std::size_t with_rotations = 61;

/// Reads a coefficient as a finite float, clamped to +-1e6; the bridge clamps it further.
float coefficient(const JsonCursor& at) { return static_cast<float>(std::clamp(at.number(), -1e6, 1e6)); }

/// The angles of Live Link Face after the 52 coefficients: three of the head, then six of the eyes, which are ignored.
std::optional<std::size_t> find_rotation(std::string_view name) {
  constexpr std::array<std::string_view, 9> names = {"eadYaw",     "eadPitch",     "eadRoll",
                                                     "eftEyeYaw",  "eftEyePitch",  "eftEyeRoll",
                                                     "ightEyeYaw", "ightEyePitch", "ightEyeRoll"};
  constexpr std::string_view initials = "hhhlllrrr";
  if (name.empty()) return std::nullopt;
  for (std::size_t r = 0; r < names.size(); ++r) {
    const bool initial = name[0] == initials[r] || name[0] == initials[r] - 'a' + 'A';
    if (initial && name.substr(1) == names[r]) return r;
  }
  return std::nullopt;
}

void read_arkit(const JsonCursor& at, semblante_frame& frame, std::size_t& clamped) {
  ArkitCoefficients coefficients{};
  HeadTurn turn;
  const auto set = [&](std::size_t index, const JsonCursor& value) {
    const float number = coefficient(value);
    if (index < arkit_count) coefficients[index] = number;
    if (index == arkit_count) turn.yaw = number;
    if (index == arkit_count + 1) turn.pitch = number;
    if (index == arkit_count + 2) turn.roll = number;
  };
  if (at.is_array()) {
    const auto elements = at.elements(arkit_count, with_rotations);
    if (elements.size() != arkit_count && elements.size() != with_rotations) {
      at.fail(ErrorCode::out_of_range, "must have 52 elements, or 61 with the angles of head and eyes");
    }
    for (std::size_t i = 0; i < elements.size(); ++i) set(i, elements[i]);
  } else {
    for (const auto& [name, value] : at.members()) {
      if (const auto shape = find_arkit(name)) {
        set(*shape, value);
      } else if (const auto rotation = find_rotation(name)) {
        set(arkit_count + *rotation, value);
      } else {
        value.fail(ErrorCode::invalid_argument, "is not one of ARKit's 52 shapes or an angle of head or eyes");
      }
    }
  }
  if (at.failed()) return;
  if (const auto made = frame_from_arkit(coefficients)) {
    frame = made->frame;
    clamped += made->clamped;
    turn_head(frame, turn);
  }
}

void read_oculus(const JsonCursor& at, semblante_frame& frame, std::size_t& clamped) {
  OculusWeights weights{};
  if (at.is_array()) {
    const auto elements = at.elements(oculus_count, oculus_count);
    for (std::size_t v = 0; v < elements.size(); ++v) weights[v] = coefficient(elements[v]);
  } else {
    for (const auto& [name, value] : at.members()) {
      if (const auto viseme = find_oculus(name)) {
        weights[*viseme] = coefficient(value);
      } else {
        value.fail(ErrorCode::invalid_argument,
                   "is not one of the visemes sil PP FF TH DD kk CH SS nn RR aa E ih oh ou");
      }
    }
  }
  if (at.failed()) return;
  if (const auto made = frame_from_oculus(weights)) {
    frame.viseme1 = made->frame.viseme1;
    frame.viseme2 = made->frame.viseme2;
    frame.viseme_blend = made->frame.viseme_blend;
    clamped += made->clamped;
  }
}

}  // namespace

std::optional<semblante_frame> read_json_bridges(const JsonCursor& frame, std::size_t& clamped) {
  const auto arkit = frame.optional_member("arkit");
  const auto oculus = frame.optional_member("oculus");
  if (!arkit && !oculus) return std::nullopt;
  if (oculus && frame.optional_member("viseme")) {
    oculus->fail(ErrorCode::invalid_argument, "is not allowed beside `viseme`");
  }
  semblante_frame result{};
  if (arkit) read_arkit(*arkit, result, clamped);
  if (oculus) read_oculus(*oculus, result, clamped);
  return result;
}

}  // namespace semblante
