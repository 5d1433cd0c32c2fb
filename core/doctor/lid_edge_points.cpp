#include <algorithm>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/geometric.hpp>

#include "core/anatomy/point_lookup.h"
#include "core/anatomy/seen_lid_edge.h"
#include "core/doctor/point_checks.h"
#include "core/doctor/words.h"
#include "core/tables/openings.h"

namespace semblante {
namespace {

/// The vertex of the point's part that is nearest to a place, and that no point has.
std::optional<SurfaceVertexId> nearest_free(const Subject& head, std::span<const SurfacePoint> points,
                                            const SurfacePoint& point, const glm::dvec3& place) {
  std::optional<SurfaceVertexId> nearest;
  double least = std::numeric_limits<double>::infinity();
  for (const SurfaceVertexId v : head.surface.members_of(head.surface.part_of[point.vertex.value()])) {
    const double distance = glm::distance(head.surface.positions[v.value()], place);
    if (distance >= least) continue;
    if (std::any_of(points.begin(), points.end(), [&](const SurfacePoint& p) { return p.vertex == v; })) continue;
    least = distance;
    nearest = v;
  }
  return nearest;
}

}  // namespace

std::vector<Finding> find_points_off_lid_edge(const Subject& head) {
  std::vector<Finding> findings;
  const std::vector<SurfacePoint> points = surface_points(head.surface, head.rig.points);
  for (const std::size_t eye : {0U, 1U}) {
    const mpeg4::Opening& opening = mpeg4::lids_of(eye);
    const SurfacePoint* const upper = point_named(points, opening.upper.front());
    const SurfacePoint* const lower = point_named(points, opening.lower.front());
    if (upper == nullptr || lower == nullptr || upper->position.y <= lower->position.y) continue;
    for (const bool is_upper : {true, false}) {
      const SurfacePoint& point = is_upper ? *upper : *lower;
      if (is_misplaced(head.misplaced, point.id)) continue;
      const auto edge = seen_lid_edge(head.surface, head.rig.parts, head.model.triangles, {}, point.position,
                                      (is_upper ? *lower : *upper).position);
      const double eye_separation = head.frame.eye_separation.value_or(0.0);
      if (!edge || is_on_edge(edge->share * edge->way, edge->way, eye_separation)) continue;
      const auto vertex = nearest_free(head, points, point, edge->place);
      const double before = glm::distance(point.position, edge->place);
      if (!vertex || glm::distance(head.surface.positions[vertex->value()], edge->place) > 0.5 * before) continue;
      Finding finding;
      finding.code = FindingCode::point_off_lid_edge;
      finding.severity = Severity::warning;
      finding.place.part = head.surface.part_of[point.vertex.value()];
      finding.place.points.push_back(point.id);
      finding.place.vertices.add(head.surface.file_vertex_of[point.vertex.value()]);
      finding.place.position = point.position;
      const std::string lid(is_upper ? opening.upper_name : opening.lower_name);
      finding.words = to_string(point.id) + " lies on the fold of the " + lid + " instead of its edge: seen from the " +
                      "front, skin covers " + percent(edge->share) +
                      " of the way from it to the other lid; a blink leaves the eye open and creases the fold";
      const VertexId to = head.surface.file_vertex_of[vertex->value()];
      finding.move = Move{point.id, to, head.surface.positions[vertex->value()]};
      finding.remedy =
          "move " + to_string(point.id) + " to vertex " + std::to_string(to.value()) + ", on the edge of the " + lid;
      finding.measured = {"skin seen between the point and the eyeball as a fraction of the distance of the lids",
                          edge->share, least_share_of_fold};
      findings.push_back(std::move(finding));
    }
  }
  return findings;
}

}  // namespace semblante
