#include "core/extract/own_articulation.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>

#include "core/expressions/contact.h"
#include "core/expressions/library.h"
#include "core/extract/named_shapes.h"

namespace semblante {
namespace {

/// The visemes that are open by the jaw: in others lips and tongue do more than it.
constexpr double least_jaw_open = 0.25;

constexpr std::string_view upper_lip = "2.2";
constexpr std::string_view lower_lip = "2.3";

std::optional<std::uint32_t> vertex_of(const FeaturePointSet& points, std::string_view name) {
  const FeaturePointId id = *parse_feature_point(name);
  const auto at = std::find_if(points.begin(), points.end(), [&](const FeaturePoint& p) { return p.id == id; });
  if (at == points.end() || !at->vertex) return std::nullopt;
  return at->vertex->value();
}

double height_of(const DisplacementSet& set, std::string_view name) {
  const FeaturePointId id = *parse_feature_point(name);
  const auto at = std::find_if(set.displacements.begin(), set.displacements.end(),
                               [&](const Displacement& d) { return d.point == id; });
  return at != set.displacements.end() ? static_cast<double>(at->value.y) : 0.0;
}

/// By how much a set opens the mouth, in units of MNS.
double opening_of(const DisplacementSet& set) { return height_of(set, upper_lip) - height_of(set, lower_lip); }

std::string with_two_digits(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.2f", value);
  return text.data();
}

}  // namespace

std::optional<Articulation> own_articulation(const Model& model, const FeaturePointSet& points, const Fapu& fapu) {
  const auto unit = units_of_library(fapu)[FapuUnit::mns];
  const auto upper = vertex_of(points, upper_lip);
  const auto lower = vertex_of(points, lower_lip);
  if (!unit || !upper || !lower) return std::nullopt;
  const NamedShapes shapes(model);
  const double by_jaw = opening_of(jaw_open_action());
  double all_own = 0.0;
  double all_ours = 0.0;
  double more = 0.0;     // sum of jaw * (own - ours)
  double squares = 0.0;  // sum of jaw^2
  std::string names;
  const auto visemes = viseme_library();
  for (std::size_t number = 1; number < visemes.size(); ++number) {
    if (visemes[number].jaw_open < least_jaw_open) continue;
    const ShapeSum sum = shapes.find(SetKind::viseme, number);
    if (sum.empty()) continue;
    const glm::vec3 apart = displacement_of(sum, *upper) - displacement_of(sum, *lower);
    const double own = static_cast<double>(apart.y) / *unit;
    const double ours = opening_of(visemes[number]);
    if (!(own >= least_articulation * ours)) continue;
    const double jaw = visemes[number].jaw_open * by_jaw;
    all_own += own;
    all_ours += ours;
    more += jaw * (own - ours);
    squares += jaw * jaw;
    names.append(names.empty() ? "" : ", ").append(visemes[number].name).append(" (" + source_of(sum) + ")");
  }
  if (!(squares > 0.0)) return std::nullopt;
  const double measured = usual_articulation + more / squares;
  Articulation result;
  result.value = std::clamp(measured, least_articulation, most_articulation);
  result.reason = "in its own " + names + " the mouth opens " + with_two_digits(all_own / all_ours) +
                  " times as far as in the library's";
  if (result.value != measured) {
    result.reason += "; that would be an articulation of " + with_two_digits(measured) + ", and " +
                     with_two_digits(result.value) + " is the limit";
  }
  return result;
}

}  // namespace semblante
