#include "server/store/frame_json.h"

#include <nlohmann/json.hpp>

namespace semblante::store {
namespace {

template <class T>
T required(const std::optional<T>& value) {
  if (!value)
    throw nlohmann::json::other_error::create(501, "is no unit or direction",
                                              static_cast<const nlohmann::json*>(nullptr));
  return *value;
}

}  // namespace

nlohmann::json frame_to_json(const ModelFrame& frame, const FrameWish& wish) {
  nlohmann::json json = {{"unit", to_string(frame.unit)},
                         {"metres_per_unit", metres_per(frame.unit)},
                         {"axes", {{"up", to_string(frame.axes.up)}, {"front", to_string(frame.axes.front)}}},
                         {"guessed", !wish.unit || !wish.has_axes()},
                         {"by_user", {{"unit", wish.unit.has_value()}, {"axes", wish.has_axes()}}},
                         {"sure", {{"unit", frame.unit_sure}, {"axes", frame.axes_sure}}},
                         {"reasons", frame.reasons}};
  if (frame.tilt != glm::dmat3(1.0)) {
    json["tilt"] = nlohmann::json::array();
    for (int row = 0; row < 3; ++row)
      json["tilt"].push_back({frame.tilt[0][row], frame.tilt[1][row], frame.tilt[2][row]});
  }
  return json;
}

ModelFrame frame_from_json(const nlohmann::json& json) {
  ModelFrame frame;
  frame.unit = required(parse_length_unit(json.at("unit").get<std::string>()));
  frame.axes.up = required(parse_direction(json.at("axes").at("up").get<std::string>()));
  frame.axes.front = required(parse_direction(json.at("axes").at("front").get<std::string>()));
  frame.unit_sure = json.at("sure").at("unit");
  frame.axes_sure = json.at("sure").at("axes");
  frame.reasons = json.at("reasons").get<std::vector<std::string>>();
  if (json.contains("tilt")) {
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column)
        json["tilt"]
            .at(static_cast<std::size_t>(row))
            .at(static_cast<std::size_t>(column))
            .get_to(frame.tilt[column][row]);
  }
  return frame;
}

nlohmann::json wish_to_json(const FrameWish& wish) {
  nlohmann::json json = nlohmann::json::object();
  if (wish.unit) json["unit"] = to_string(*wish.unit);
  if (wish.up) json["up"] = to_string(*wish.up);
  if (wish.front) json["front"] = to_string(*wish.front);
  return json;
}

FrameWish wish_from_json(const nlohmann::json& json) {
  FrameWish wish;
  if (json.contains("unit")) wish.unit = required(parse_length_unit(json["unit"].get<std::string>()));
  if (json.contains("up")) wish.up = required(parse_direction(json["up"].get<std::string>()));
  if (json.contains("front")) wish.front = required(parse_direction(json["front"].get<std::string>()));
  return wish;
}

}  // namespace semblante::store
