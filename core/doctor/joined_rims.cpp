#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include <glm/geometric.hpp>

#include "core/anatomy/point_lookup.h"
#include "core/doctor/openings.h"
#include "core/doctor/surface_way.h"
#include "core/doctor/words.h"
#include "core/geometry/edge_path_search.h"

namespace semblante {
namespace {

/// Without a fault, the path from rim to rim goes around a corner or deep inside. A shorter path than this fraction of
/// it crosses the gap.
constexpr double shortest_share = 0.5;

struct Crossing {
  const SurfacePoint* upper;
  const SurfacePoint* lower;
  double share;  ///< length of the path as a fraction of the path around the nearer corner
  std::vector<SurfaceVertexId> way;
};

/// The pair of opposite points with the shortest path, relative to the path around the nearer corner.
std::optional<Crossing> shortest_crossing(const Subject& head, const Opening& opening,
                                          std::span<const SurfacePoint> points, EdgePathSearch& search) {
  std::optional<Crossing> shortest;
  for (std::size_t i = 0; i < opening.upper.size(); ++i) {
    const SurfacePoint* const upper = point_named(points, opening.upper[i]);
    const SurfacePoint* const lower = point_named(points, opening.lower[i]);
    if (upper == nullptr || lower == nullptr || upper->vertex == lower->vertex) continue;
    // With a point on the other rim the path does not cross the gap.
    if (is_misplaced(head.misplaced, upper->id) || is_misplaced(head.misplaced, lower->id)) continue;
    // Straight lines to the corner and back: a lower bound of the path around it, independent of the mesh.
    double round = std::numeric_limits<double>::infinity();
    for (const std::string_view name : opening.corners) {
      if (const SurfacePoint* const corner = point_named(points, name))
        round = std::min(
            round, glm::distance(upper->position, corner->position) + glm::distance(corner->position, lower->position));
    }
    if (!std::isfinite(round) || round == 0.0) continue;
    const auto distances = search.from(upper->vertex);
    const double share = distances[lower->vertex.value()] / round;
    if (shortest && shortest->share <= share) continue;
    shortest = Crossing{upper, lower, share, {}};
    if (std::isfinite(share)) shortest->way = way_back(head.surface, distances, lower->vertex);
  }
  return shortest;
}

/// Opposite points at the same vertex: the rims are fused.
std::optional<Crossing> fused(const Subject& head, const Opening& opening, std::span<const SurfacePoint> points) {
  for (std::size_t i = 0; i < opening.upper.size(); ++i) {
    const SurfacePoint* const upper = point_named(points, opening.upper[i]);
    const SurfacePoint* const lower = point_named(points, opening.lower[i]);
    if (upper == nullptr || lower == nullptr || upper->vertex != lower->vertex) continue;
    if (!is_misplaced(head.misplaced, upper->id) && !is_misplaced(head.misplaced, lower->id))
      return Crossing{upper, lower, 0.0, {upper->vertex}};
  }
  return std::nullopt;
}

}  // namespace

std::vector<Finding> find_joined_rims(const Subject& head) {
  std::vector<Finding> findings;
  const std::vector<SurfacePoint> points = surface_points(head.surface, head.rig.points);
  EdgePathSearch search(head.surface);
  for (const Opening& opening : openings) {
    std::optional<Crossing> crossing = fused(head, opening, points);
    if (!crossing) crossing = shortest_crossing(head, opening, points, search);
    if (!crossing || !(crossing->share < shortest_share)) continue;
    Finding finding;
    finding.code = opening.is_mouth ? FindingCode::lips_joined : FindingCode::lids_joined;
    finding.severity = Severity::error;
    finding.place.points = {crossing->upper->id, crossing->lower->id};
    finding.place.part = head.surface.part_of[crossing->upper->vertex.value()];
    for (const SurfaceVertexId vertex : crossing->way)
      finding.place.vertices.add(head.surface.file_vertex_of[vertex.value()]);
    finding.place.position = 0.5 * (crossing->upper->position + crossing->lower->position);
    const std::string name(opening.name);
    finding.words = "the " + name + " are joined: from " + to_string(crossing->upper->id) + " to " +
                    to_string(crossing->lower->id) + " the path along the surface crosses the gap, with " +
                    percent(crossing->share) + " of the distance around the corner; so one moves the other, and the " +
                    (opening.is_mouth ? "mouth" : "eye") + " cannot open or close cleanly";
    finding.remedy =
        "delete the faces that span the gap between the " + name +
        ", or split the vertices that both share; smooth weights suffer less from it than those of the paper";
    finding.measured = {"path across as a fraction of the distance around the nearer corner", crossing->share,
                        shortest_share};
    findings.push_back(std::move(finding));
  }
  return findings;
}

}  // namespace semblante
