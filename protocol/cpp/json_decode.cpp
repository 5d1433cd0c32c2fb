#include <algorithm>
#include <cmath>

#include "core/json/base64.h"
#include "core/json/json_cursor.h"
#include "core/json/json_tree.h"
#include "protocol/cpp/face_frame.h"
#include "protocol/cpp/fap_number.h"
#include "protocol/cpp/json_bridges.h"
#include "protocol/cpp/json_codec.h"
#include "protocol/cpp/opus_packet.h"
#include "protocol/cpp/speech_score.h"

namespace semblante {
namespace {

/// A frame has 160 values at most: FAPs, ARKit's coefficients and Oculus's weights at once.
constexpr std::size_t max_message_values = 200'000;
static_assert(max_message_values > 160 * max_frames_per_message);
constexpr JsonLimits message_limits = {
    .max_bytes = max_json_message_bytes, .max_depth = 64, .max_values = max_message_values};

std::uint8_t small(const JsonCursor& at, std::uint8_t most) { return static_cast<std::uint8_t>(at.integer(0, most)); }

std::uint8_t small_or(const JsonCursor& of, const char* name, std::uint8_t most, std::uint8_t otherwise) {
  const auto at = of.optional_member(name);
  return at ? small(*at, most) : otherwise;
}

/// "3".."68" -> the number; 0 for anything else.
std::size_t low_level_fap(std::string_view name) {
  if (name.empty() || name.size() > 2 || name[0] == '0') return 0;
  std::size_t number = 0;
  for (const char c : name) {
    if (c < '0' || c > '9') return 0;
    number = number * 10 + static_cast<std::size_t>(c - '0');
  }
  return number >= first_low_level_fap && number <= last_low_level_fap ? number : 0;
}

/// A FaceFrame or FaceValues; `set(state, fap, units, at)` puts a low-level FAP into it. `clamped`: as
/// read_json_bridges.
template <class State, class Set>
State read_state_of(const JsonCursor& at, const Set& set, std::size_t& clamped) {
  State state;
  if (const auto bridged = read_json_bridges(at, clamped)) {
    state.viseme = {bridged->viseme1, bridged->viseme2, bridged->viseme_blend};
    for (std::size_t fap = first_low_level_fap; fap <= last_low_level_fap; ++fap) {
      set(state, fap, static_cast<double>(bridged->fap[fap]), at);
    }
  }
  if (const auto viseme = at.optional_member("viseme")) {
    state.viseme.select1 = small(viseme->member("select1"), max_viseme);
    state.viseme.select2 = small_or(*viseme, "select2", max_viseme, 0);
    state.viseme.blend = small_or(*viseme, "blend", max_blend, max_blend);
  }
  if (const auto expression = at.optional_member("expression")) {
    state.expression.select1 = small(expression->member("select1"), max_expression);
    state.expression.intensity1 = small_or(*expression, "intensity1", max_blend, max_blend);
    state.expression.select2 = small_or(*expression, "select2", max_expression, 0);
    state.expression.intensity2 = small_or(*expression, "intensity2", max_blend, 0);
  }
  if (const auto faps = at.optional_member("faps")) {
    for (const auto& [name, value] : faps->members()) {
      const std::size_t fap = low_level_fap(name);
      if (fap == 0) {
        value.fail(ErrorCode::out_of_range, "low-level FAPs are 3 to 68; 1 and 2 are `viseme` and `expression`");
        continue;
      }
      const double units = value.number();
      if (value.failed()) continue;
      set(state, fap, units, value);
    }
  }
  return state;
}

FaceFrame read_frame(const JsonCursor& at, const QuantizerSteps& steps, std::size_t& clamped) {
  const auto set = [&](FaceFrame& state, std::size_t fap, double units, const JsonCursor& value) {
    const auto level = quantize(units, steps[fap]);
    if (!level) value.fail(level.error().code, level.error().message);
    state.level[fap] = level ? *level : std::int16_t{0};
  };
  return read_state_of<FaceFrame>(at, set, clamped);
}

FaceValues read_values(const JsonCursor& at) {
  const auto set = [](FaceValues& state, std::size_t fap, double units, const JsonCursor& value) {
    if (std::abs(units) > max_fap_value) value.fail(ErrorCode::out_of_range, "is beyond 1e9 FAP units");
    state.fap[fap] = units;
  };
  std::size_t clamped = 0;  // not reported for files
  return read_state_of<FaceValues>(at, set, clamped);
}

/// The time of a frame; by default `before`, the time of the frame before it.
std::uint32_t read_time(const JsonCursor& frame, std::uint32_t before) {
  const auto given = frame.optional_member("time");
  if (!given) return before;
  const auto time = static_cast<std::uint32_t>(given->integer(0, max_frame_time));
  if (time < before) given->fail(ErrorCode::out_of_range, "times must not decrease");
  return time;
}

std::vector<TimedFrame> read_frames(const JsonCursor& at, const QuantizerSteps& steps, std::size_t& clamped) {
  std::vector<TimedFrame> frames;
  std::uint32_t time = 0;
  for (const auto& element : at.elements(1, max_frames_per_message)) {
    time = read_time(element, time);
    frames.push_back({time, read_frame(element, steps, clamped)});
    if (at.failed()) break;
  }
  return frames;
}

class JsonFieldReader {
 public:
  JsonFieldReader(const JsonCursor& at, const QuantizerSteps& steps) : at_(at), steps_(steps) {}

  template <class Int>
  void uint(const char* name, Int& value, std::uint64_t max, Presence presence) {
    if (const auto at = find(name, presence)) value = static_cast<Int>(at->integer(0, max));
  }
  void real(const char* name, double& value, double min, double max, Presence presence) {
    if (const auto at = find(name, presence)) value = at->number(min, max);
  }
  void boolean(const char* name, bool& value, Presence presence) {
    if (const auto at = find(name, presence)) value = at->boolean();
  }
  void text(const char* name, std::string& value, std::size_t max, Presence presence) {
    if (const auto at = find(name, presence)) value = at->text(max);
  }
  void reals(const char* name, std::vector<double>& values, std::size_t length, double min, double max,
             Presence presence) {
    const auto at = find(name, presence);
    if (!at || at->is_empty_array()) return;
    for (const auto& element : at->elements(length, length)) values.push_back(element.number(min, max));
  }
  template <class E>
  void enumeration(const char* name, E& value, const EnumNames& names, Presence presence) {
    const auto at = find(name, presence);
    if (!at) return;
    const std::string text = at->text(64);
    const auto found = std::find(names.names.begin(), names.names.end(), text);
    if (found == names.names.end() && !names.open) {
      return at->fail(ErrorCode::invalid_argument, "\"" + text + "\" is not one of the known values");
    }
    value = static_cast<E>(found == names.names.end() ? 0 : found - names.names.begin());
  }
  void bytes(const char* name, std::vector<std::uint8_t>& value, std::size_t max, Presence presence) {
    const auto at = find(name, presence);
    if (!at) return;
    auto bytes = from_base64(at->text((max + 2) / 3 * 4));
    if (!bytes) return at->fail(ErrorCode::malformed, "must be base64");
    if (bytes->size() > max) return at->fail(ErrorCode::too_large, "must not exceed " + std::to_string(max) + " bytes");
    value = *std::move(bytes);
  }
  template <class T>
  void optional(const char* name, std::optional<T>& value, Presence) {
    const auto at = at_.optional_member(name);
    if (!at || at->is_null()) return;
    JsonFieldReader reader(*at, steps_);
    visit_fields(value.emplace(), reader);
  }
  void optional_real(const char* name, std::optional<double>& value, double min, double max) {
    const auto at = at_.optional_member(name);
    if (at && !at->is_null()) value = at->number(min, max);
  }
  void state(const char* name, FaceFrame& state) { state = read_frame(at_.member(name), steps_, clamped_); }
  void frames(const char* name, std::vector<TimedFrame>& frames) {
    frames = read_frames(at_.member(name), steps_, clamped_);
  }

 private:
  [[nodiscard]] std::optional<JsonCursor> find(const char* name, Presence presence) const {
    return presence == Presence::required ? std::optional(at_.member(name)) : at_.optional_member(name);
  }

  const JsonCursor& at_;
  const QuantizerSteps& steps_;
  std::size_t clamped_ = 0;  ///< not reported: a message on a WebSocket has no response
};

template <class... M>
Message read_by_name(const JsonCursor& root, const QuantizerSteps& steps, const std::variant<M...>* /*types*/) {
  const JsonCursor type = root.member("type");
  const std::string name = type.text(64);
  Message result;
  const auto read = [&]<class T>(T message) {
    JsonFieldReader reader(root, steps);
    visit_fields(message, reader);
    result = std::move(message);
    return true;
  };
  const bool known = ((MessageTraits<M>::name == name && read(M{})) || ...);
  if (!known) type.fail(ErrorCode::unsupported, "no message has the type \"" + name + "\"");
  return result;
}

}  // namespace

Result<Message> decode_json(std::string_view text, const QuantizerSteps& steps) {
  const auto tree = read_json_object_tree(text, message_limits);
  if (!tree) return tree.error();
  JsonCursor::Report report;
  Message message = read_by_name(JsonCursor(*tree, report), steps, static_cast<const Message*>(nullptr));
  if (report) return *report;
  if (const auto* sound = std::get_if<SoundPacket>(&message)) {
    if (auto status = check_sound(*sound); !status) return std::move(status).error();
  }
  if (const auto* said = std::get_if<SpeechText>(&message)) {
    if (auto status = check_text(*said); !status) return std::move(status).error();
  }
  return message;
}

Result<std::vector<TimedFrame>> decode_json_frames(std::string_view text, const QuantizerSteps& steps,
                                                   std::size_t* clamped) {
  const auto tree = read_json_object_tree(text, message_limits);
  if (!tree) return tree.error();
  JsonCursor::Report report;
  std::size_t bridged = 0;
  auto frames = read_frames(JsonCursor(*tree, report).member("frames"), steps, bridged);
  if (report) return *report;
  if (clamped != nullptr) *clamped = bridged;
  return frames;
}

Result<std::vector<TimedValues>> decode_json_values(std::string_view text, const JsonValuesLimits& limits) {
  // Frame by frame, because the JSON document of a long file would take ten times its bytes of memory.
  std::vector<TimedValues> frames;
  const auto take = [&](std::size_t index, const JsonView& frame) -> Status {
    if (index == limits.frames)
      return Error{ErrorCode::too_large, "/frames", "has more than " + std::to_string(limits.frames) + " elements"};
    JsonCursor::Report report;
    const JsonCursor at(frame, "/frames/" + std::to_string(index), report);
    const std::uint32_t time = read_time(at, frames.empty() ? 0 : frames.back().time);
    frames.push_back({time, read_values(at)});
    if (report) return *report;
    return Unit{};
  };
  const JsonElements elements{"frames", take};
  const auto tree = read_json_object_tree(
      text, {.max_bytes = limits.bytes, .max_depth = 64, .max_values = max_message_values}, &elements);
  if (!tree) return tree.error();
  JsonCursor::Report report;
  const JsonCursor list = JsonCursor(*tree, report).member("frames");
  if (frames.empty()) (void)list.elements(1, limits.frames);
  if (report) return *report;
  return frames;
}

}  // namespace semblante
