#include "server/cli/weights_json.h"

#include <array>
#include <charconv>
#include <ostream>
#include <string>

#include <nlohmann/json.hpp>

#include "server/report/fit_json.h"

namespace semblante {

void write_weights_json(const Rig& rig, const RigRequest& made, std::ostream& out) {
  std::array<std::string, feature_point_count> quoted;
  for (std::uint8_t i = 0; i < feature_point_count; ++i) quoted[i] = '"' + to_string(FeaturePointId(i)) + '"';

  const auto name_of = [](const auto& names, auto value) {
    return std::string(names[static_cast<std::size_t>(value)]);
  };
  constexpr auto replaced = nlohmann::ordered_json::error_handler_t::replace;
  std::string text = "{\"weights\": \"" + name_of(weight_method_names, made.weights);
  text += "\", \"metric\": \"" + name_of(distance_metric_names, made.metric);
  text += std::string("\", \"shares\": ") + (are_shares(made.weights) ? "true" : "false");
  if (rig.fit) text += ",\n\"fit\": " + weight_fit_json(*rig.fit).dump(-1, ' ', false, replaced);
  text += ",\n\"points\": [";
  for (std::size_t i = 0; i < rig.points.size(); ++i) {
    if (i > 0) text += ", ";
    text += quoted[rig.points[i].id.value()];
  }
  text += "],\n\"vertices\": [";
  constexpr std::size_t flush_at = std::size_t{1} << 16;
  for (std::size_t row = 0; row < rig.weights.row_count(); ++row) {
    text += row == 0 ? "\n[" : ",\n[";
    const auto points = rig.weights.points_of(row);
    const auto weights = rig.weights.weights_of(row);
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (i > 0) text += ", ";
      text += '[';
      text += quoted[points[i].value()];
      text += ", ";
      std::array<char, 32> digits{};
      const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), weights[i]).ptr;
      text.append(digits.data(), end);
      text += ']';
    }
    text += ']';
    if (text.size() > flush_at) {
      out << text;
      text.clear();
    }
  }
  out << text << "\n]}\n";
}

}  // namespace semblante
