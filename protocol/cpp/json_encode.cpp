#include <cassert>
#include <cmath>

#include <nlohmann/json.hpp>

#include "core/json/base64.h"
#include "protocol/cpp/face_frame.h"
#include "protocol/cpp/json_codec.h"
#include "protocol/cpp/json_number.h"

namespace semblante {
namespace {

using Json = nlohmann::ordered_json;

void write_viseme(Json& to, const VisemeBlend& viseme) {
  to["viseme"] = {{"select1", viseme.select1}, {"select2", viseme.select2}, {"blend", viseme.blend}};
}

void write_expression(Json& to, const ExpressionBlend& expression) {
  to["expression"] = {{"select1", expression.select1},
                      {"intensity1", expression.intensity1},
                      {"select2", expression.select2},
                      {"intensity2", expression.intensity2}};
}

void write_state(Json& to, const FaceFrame& state, const QuantizerSteps& steps) {
  assert(is_valid(state));
  write_viseme(to, state.viseme);
  write_expression(to, state.expression);
  Json faps = Json::object();
  for (std::size_t fap = first_low_level_fap; fap <= last_low_level_fap; ++fap) {
    if (state.level[fap] != 0) faps[std::to_string(fap)] = json_number<Json>(state.level[fap] * steps[fap]);
  }
  to["faps"] = std::move(faps);
}

class JsonFieldWriter {
 public:
  JsonFieldWriter(Json& to, const QuantizerSteps& steps) : to_(to), steps_(steps) {}

  void uint(const char* name, std::uint64_t value, [[maybe_unused]] std::uint64_t max, Presence) {
    assert(value <= max);
    to_[name] = value;
  }
  void real(const char* name, double value, [[maybe_unused]] double min, [[maybe_unused]] double max, Presence) {
    assert(value >= min && value <= max);
    to_[name] = json_number<Json>(value);
  }
  void boolean(const char* name, bool value, Presence presence) {
    if (presence != Presence::appended || value) to_[name] = value;
  }
  void text(const char* name, const std::string& value, [[maybe_unused]] std::size_t max, Presence) {
    assert(value.size() <= max);
    to_[name] = value;
  }
  void reals(const char* name, const std::vector<double>& values, [[maybe_unused]] std::size_t length, double, double,
             Presence) {
    assert(values.empty() || values.size() == length);
    to_[name] = Json::array();
    for (const double value : values) to_[name].push_back(json_number<Json>(value));
  }
  template <class E>
  void enumeration(const char* name, E value, const EnumNames& names, Presence presence) {
    if (presence == Presence::appended && value == E{}) return;
    to_[name] = names.names[static_cast<std::size_t>(value)];
  }
  void bytes(const char* name, const std::vector<std::uint8_t>& value, [[maybe_unused]] std::size_t max, Presence) {
    assert(value.size() <= max);
    to_[name] = to_base64(value);
  }
  template <class T>
  void optional(const char* name, const std::optional<T>& value, Presence) {
    if (!value.has_value()) return;
    Json inner = Json::object();
    JsonFieldWriter writer(inner, steps_);
    visit_fields(*value, writer);
    to_[name] = std::move(inner);
  }
  void optional_real(const char* name, const std::optional<double>& value, double min, double max) {
    if (value.has_value()) real(name, *value, min, max, Presence::required);
  }
  void state(const char* name, const FaceFrame& state) { write_state(to_[name] = Json::object(), state, steps_); }
  void frames(const char* name, const std::vector<TimedFrame>& frames) {
    Json list = Json::array();
    for (const TimedFrame& frame : frames) {
      Json item = {{"time", frame.time}};
      write_state(item, frame.state, steps_);
      list.push_back(std::move(item));
    }
    to_[name] = std::move(list);
  }

 private:
  Json& to_;
  const QuantizerSteps& steps_;
};

}  // namespace

std::string encode_json(const Message& message, const QuantizerSteps& steps) {
  Json json;
  std::visit(
      [&]<class M>(const M& m) {
        json["type"] = MessageTraits<M>::name;
        JsonFieldWriter writer(json, steps);
        visit_fields(m, writer);
      },
      message);
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string encode_json_value(const TimedValues& frame) {
  const auto& [time, state] = frame;
  Json item = {{"time", time}};
  if (!(state.viseme == VisemeBlend{})) write_viseme(item, state.viseme);
  if (!(state.expression == ExpressionBlend{})) write_expression(item, state.expression);
  Json faps = Json::object();
  for (std::size_t fap = first_low_level_fap; fap <= last_low_level_fap; ++fap) {
    if (state.fap[fap] != 0.0) faps[std::to_string(fap)] = json_number<Json>(state.fap[fap]);
  }
  if (!faps.empty()) item["faps"] = std::move(faps);
  return item.dump();
}

std::string encode_json_values(std::span<const TimedValues> frames) {
  std::string text = "{\"frames\": [";
  for (const auto& frame : frames) text.append(text.back() == '[' ? "\n" : ",\n").append(encode_json_value(frame));
  return text + "\n]}\n";
}

}  // namespace semblante
