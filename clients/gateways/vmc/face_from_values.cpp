#include <algorithm>
#include <cmath>

#include "clients/gateways/vmc/turn.h"
#include "clients/gateways/vmc/values.h"
#include "core/bridges/arkit_shapes.h"
#include "core/bridges/head_turn.h"
#include "core/tables/mpeg4.h"

namespace semblante::vmc {
namespace {

float in_units(std::size_t fap, double radians) {
  const mpeg4::Fap& range = mpeg4::fap(fap);
  return static_cast<float>(
      std::clamp(radians / mpeg4::radians_per_au, static_cast<double>(range.min()), static_cast<double>(range.max())));
}

/// Sets the coefficients of the gaze, which the lids follow.
void look(const arkit::Eye& eye, const Turn& turn, ArkitCoefficients& coefficients) {
  const auto share = [](double angle) {
    return static_cast<float>(std::clamp(angle * 1e5 / arkit::full_turn, 0.0, 1.0));
  };
  coefficients[eye.look_out] = share(eye.outwards * turn.yaw);
  coefficients[eye.look_in] = share(-eye.outwards * turn.yaw);
  coefficients[eye.look_down] = share(turn.pitch);
  coefficients[eye.look_up] = share(-turn.pitch);
}

ArkitCoefficients coefficients_of_presets(const Values& values) {
  ArkitCoefficients coefficients{};
  for (std::size_t i = 0; i < values.presets.size(); ++i) {
    for (const std::size_t shape : vrm_presets()[i].arkit) {
      coefficients[shape] = std::max(coefficients[shape], std::clamp(values.presets[i], 0.0F, 1.0F));
    }
  }
  if (values.eye_bones) {
    for (std::size_t side = 0; side < 2; ++side) look(arkit::eyes[side], to_turn(values.eyes[side]), coefficients);
  }
  return coefficients;
}

void speak_by_presets(const Values& values, semblante_frame& frame) {
  OculusWeights weights{};
  float sum = 0.0F;
  for (std::size_t i = 0; i < values.presets.size(); ++i) {
    const auto& viseme = vrm_presets()[i].viseme;
    if (!viseme) continue;
    weights[*viseme] = std::clamp(values.presets[i], 0.0F, 1.0F);
    sum += weights[*viseme];
  }
  if (sum <= 0.0F) return;
  if (const auto made = frame_from_oculus(weights)) {
    frame.viseme1 = made->frame.viseme1;
    frame.viseme2 = made->frame.viseme2;
    frame.viseme_blend = made->frame.viseme_blend;
  }
}

/// Removes the strongest expression and returns its number.
std::uint8_t strongest(std::array<float, SEMBLANTE_EXPRESSION_COUNT>& amounts, std::uint8_t& intensity) {
  const auto most = std::max_element(amounts.begin(), amounts.end());
  intensity = static_cast<std::uint8_t>(std::lround(std::min(*most, 1.0F) * SEMBLANTE_BLEND_MAX));
  *most = 0.0F;
  return intensity == 0 ? std::uint8_t{0} : static_cast<std::uint8_t>(most - amounts.begin());
}

void feel_by_presets(const Values& values, semblante_frame& frame) {
  std::array<float, SEMBLANTE_EXPRESSION_COUNT> amounts{};
  for (std::size_t i = 0; i < values.presets.size(); ++i) {
    const VrmPreset& preset = vrm_presets()[i];
    if (preset.expression == 0) continue;
    amounts[preset.expression] += preset.amount * std::clamp(values.presets[i], 0.0F, 1.0F);
  }
  frame.expression1 = strongest(amounts, frame.intensity1);
  frame.expression2 = strongest(amounts, frame.intensity2);
}

}  // namespace

semblante_frame face_from_values(const Values& values, std::size_t& clamped) {
  for (const float value : values.presets) clamped += value < 0.0F || value > 1.0F ? 1 : 0;
  semblante_frame frame{};
  if (const auto made =
          frame_from_arkit(values.has_perfect_sync ? values.perfect_sync : coefficients_of_presets(values))) {
    frame = made->frame;
    clamped += made->clamped;
  }
  if (!values.has_perfect_sync) speak_by_presets(values, frame);
  feel_by_presets(values, frame);
  const Turn head = to_turn(values.neck * values.head);
  turn_head(frame, {static_cast<float>(-head.yaw), static_cast<float>(head.pitch), static_cast<float>(head.roll)});
  for (std::size_t side = 0; values.eye_bones && side < 2; ++side) {
    const Turn turn = to_turn(values.eyes[side]);
    frame.fap[arkit::eyes[side].yaw] = in_units(arkit::eyes[side].yaw, turn.yaw);
    frame.fap[arkit::eyes[side].pitch] = in_units(arkit::eyes[side].pitch, turn.pitch);
  }
  return frame;
}

}  // namespace semblante::vmc
