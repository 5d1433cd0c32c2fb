#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include <glm/geometric.hpp>

#include "core/anatomy/point_lookup.h"
#include "core/doctor/openings.h"
#include "core/doctor/words.h"
#include "core/geometry/edge_path_search.h"

namespace semblante {
namespace {

/// Visible threshold: if a lip follows the other by a tenth, it moves by several millimetres when the mouth opens by
/// its width.
constexpr double most_share = 0.10;
/// Extent of a lip or lid from its points, in ES0, if its two contours are not both marked.
constexpr double usual_reach = 0.12;

using Ids = std::vector<FeaturePointId>;

Ids ids_of(std::span<const std::string_view> names) {
  Ids ids;
  for (const std::string_view name : names) ids.push_back(*parse_feature_point(name));
  return ids;
}

std::vector<SurfaceVertexId> vertices_of(std::span<const SurfacePoint> points, const Ids& ids) {
  std::vector<SurfaceVertexId> vertices;
  for (const SurfacePoint& point : points)
    if (std::find(ids.begin(), ids.end(), point.id) != ids.end()) vertices.push_back(point.vertex);
  return vertices;
}

/// Extent of a lip or lid: distance from the rim to the outer contour.
double reach_of(const Subject& head, std::span<const std::string_view> flesh, std::string_view outer) {
  const FeaturePoint* const inner_point = find_point(head.rig.points, flesh.front());
  const FeaturePoint* const outer_point = find_point(head.rig.points, outer);
  if (inner_point != nullptr && outer_point != nullptr)
    return glm::distance(glm::dvec3(inner_point->position), glm::dvec3(outer_point->position));
  return usual_reach * head.frame.eye_separation.value_or(0.0);
}

struct Leak {
  VertexSample vertices;
  double worst = 0.0;
  VertexId worst_at;
};

/// The total weight of the points `from` at the vertices near the points `into`.
Leak leak(const Subject& head, std::span<const double> to_into, std::span<const double> to_others, double reach,
          const Ids& from) {
  Leak leak;
  const auto& influence = head.rig.influence;
  for (std::uint32_t s = 0; s < head.surface.vertex_count(); ++s) {
    if (!(to_into[s] <= reach) || !(to_into[s] < to_others[s])) continue;
    const VertexId vertex = head.surface.file_vertex_of[s];
    const auto points = influence.points_of(vertex.value());
    const auto weights = influence.weights_of(vertex.value());
    double share = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i)
      if (std::find(from.begin(), from.end(), points[i]) != from.end()) share += static_cast<double>(weights[i]);
    if (share > leak.worst) {
      leak.worst = share;
      leak.worst_at = vertex;
    }
    if (share > most_share) leak.vertices.add(vertex);
  }
  return leak;
}

std::optional<Finding> tell(const Subject& head, const Opening& opening, Leak leak,
                            std::span<const std::string_view> from, std::span<const std::string_view> into) {
  if (leak.vertices.count == 0) return std::nullopt;
  const bool up = into.front() == opening.upper.front();
  const std::string part = opening.is_mouth ? "lip" : opening.name == openings[1].name ? "left lid" : "right lid";
  Finding finding;
  finding.code = opening.is_mouth ? FindingCode::lips_leak : FindingCode::lids_leak;
  // Eq. 1 to 4 distribute every vertex among the surrounding points, also across a slit; the head is not at fault.
  finding.severity = head.method == WeightMethod::paper ? Severity::note : Severity::warning;
  finding.place.part = head.surface.part_of[head.surface.surface_of[leak.worst_at.value()].value()];
  finding.place.points = {*parse_feature_point(from.front()), *parse_feature_point(into.front())};
  finding.place.position = glm::dvec3(head.model.positions[leak.worst_at.value()]);
  finding.words = count_of(leak.vertices.count, "vertex", "vertices") + " of the " + (up ? "upper " : "lower ") + part +
                  (leak.vertices.count == 1 ? " follows" : " follow") + " the points of the " +
                  (up ? "lower" : "upper") + " one by more than a tenth, at most by " + percent(leak.worst) +
                  "; they move along when only the other should";
  finding.remedy = head.method == WeightMethod::paper
                       ? "use smooth weights, which do not leak; it is inherent in the weights of the paper"
                       : "check the connection of the two, and the points near the place";
  finding.place.vertices = std::move(leak.vertices);
  finding.measured = {"largest weight of the other's points", leak.worst, most_share};
  return finding;
}

}  // namespace

std::vector<Finding> find_leaks(const Subject& head) {
  std::vector<Finding> findings;
  const std::vector<SurfacePoint> points = surface_points(head.surface, head.rig.points);
  EdgePathSearch search(head.surface);
  for (const Opening& opening : openings) {
    // A point on the other rim makes that rim follow it, which has a finding of its own.
    if (std::any_of(head.misplaced.begin(), head.misplaced.end(),
                    [&](const MisplacedRimPoint& m) { return m.opening == &opening; }))
      continue;
    const Ids upper = ids_of(opening.upper_flesh);
    const Ids lower = ids_of(opening.lower_flesh);
    Ids corners = ids_of(opening.corners);
    if (opening.is_mouth) {
      corners.push_back(*parse_feature_point("8.3"));
      corners.push_back(*parse_feature_point("8.4"));
    }
    const auto distances = [&](std::initializer_list<const Ids*> sets) {
      std::vector<SurfaceVertexId> sources;
      for (const Ids* const set : sets) {
        const auto more = vertices_of(points, *set);
        sources.insert(sources.end(), more.begin(), more.end());
      }
      const auto found = search.from(sources);
      return std::vector<double>(found.begin(), found.end());
    };
    const auto to_upper = distances({&upper});
    const auto to_lower = distances({&lower});
    const auto not_upper = distances({&lower, &corners});
    const auto not_lower = distances({&upper, &corners});
    const std::string_view outer_upper = opening.is_mouth ? "8.1" : opening.upper_flesh[1];
    const std::string_view outer_lower = opening.is_mouth ? "8.2" : opening.lower_flesh[1];
    Leak up = leak(head, to_upper, not_upper, reach_of(head, opening.upper_flesh, outer_upper), lower);
    Leak down = leak(head, to_lower, not_lower, reach_of(head, opening.lower_flesh, outer_lower), upper);
    if (auto finding = tell(head, opening, std::move(up), opening.lower_flesh, opening.upper_flesh))
      findings.push_back(std::move(*finding));
    if (auto finding = tell(head, opening, std::move(down), opening.upper_flesh, opening.lower_flesh))
      findings.push_back(std::move(*finding));
  }
  return findings;
}

}  // namespace semblante
