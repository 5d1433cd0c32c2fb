#include "core/doctor/marked_points.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include "core/parametrize/place_feature_points.h"

namespace semblante {
namespace {

/// The feature point in an error's pointer "/points/<id>...".
std::optional<FeaturePointId> point_of(std::string_view where) {
  constexpr std::string_view before = "/points/";
  if (!where.starts_with(before)) return std::nullopt;
  where.remove_prefix(before.size());
  return parse_feature_point(where.substr(0, where.find('/')));
}

}  // namespace

PlacedPoints place_what_can_be(const Model& model, const Surface& surface, std::vector<MarkedPoint> marked,
                               std::span<const std::optional<PartRole>> roles_by_user) {
  PlacedPoints placed;
  while (true) {
    placed.warnings.clear();
    auto points = place_feature_points(model, surface, marked, &placed.warnings, roles_by_user);
    if (points) {
      placed.points = std::move(*points);
      return placed;
    }
    const auto id = point_of(points.error().where);
    const auto at = std::find_if(marked.begin(), marked.end(), [&](const MarkedPoint& p) { return id && p.id == *id; });
    Finding finding;
    finding.code = FindingCode::point_refused;
    finding.severity = Severity::error;
    finding.words = points.error().message + "; it was omitted";
    finding.remedy = "mark the point again";
    if (at != marked.end()) {
      finding.place.points.push_back(at->id);
      if (at->vertex && *at->vertex < model.positions.size()) {
        finding.place.vertices.add(VertexId(*at->vertex));
        finding.place.position = glm::dvec3(model.positions[*at->vertex]);
        finding.place.part = surface.part_of[surface.surface_of[*at->vertex].value()];
      }
    }
    placed.refused.push_back(std::move(finding));
    if (at == marked.end()) return placed;
    marked.erase(at);
  }
}

}  // namespace semblante
