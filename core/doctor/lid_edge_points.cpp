#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/geometric.hpp>

#include "core/anatomy/point_lookup.h"
#include "core/doctor/point_checks.h"
#include "core/doctor/words.h"
#include "core/tables/openings.h"

namespace semblante {
namespace {

/// Skin between a lid's point and the eye that is seen, as a share of the distance of both lids' points. On heads whose
/// points are on the edges it is below 0.1.
constexpr double fold_share = 0.15;
/// Of ES0, 1.3 mm: of eyes that are nearly shut the least skin is a great share.
constexpr double least_fold = 0.02;
/// Heights at which the front of the face is looked at.
constexpr int steps = 64;

/// What is seen straight from the front in the plane of one x: the nearest surface at each height.
class FrontColumn {
 public:
  FrontColumn(const Subject& head, double x) {
    for (const Triangle& t : head.model.triangles) {
      const PartRole role = head.rig.parts[head.surface.part_of[head.surface.surface_of[t[0]].value()].value()].role;
      const bool is_skin = role == PartRole::skin;
      if (!is_skin && role != PartRole::left_eye && role != PartRole::right_eye) continue;
      std::vector<glm::dvec3> cut;
      for (std::size_t k = 0; k < 3; ++k) {
        const glm::dvec3 a(head.model.positions[t[k]]);
        const glm::dvec3 b(head.model.positions[t[(k + 1) % 3]]);
        if ((a.x < x) != (b.x < x)) cut.push_back(a + (x - a.x) / (b.x - a.x) * (b - a));
      }
      if (cut.size() == 2) pieces_.push_back({cut[0], cut[1], is_skin});
    }
  }

  struct Seen {
    bool is_skin = false;
    double z = -std::numeric_limits<double>::infinity();
  };
  [[nodiscard]] std::optional<Seen> at(double y) const {
    std::optional<Seen> nearest;
    for (const auto& [a, b, is_skin] : pieces_) {
      if ((a.y < y) == (b.y < y)) continue;
      const double z = a.z + (y - a.y) / (b.y - a.y) * (b.z - a.z);
      if (!nearest || z > nearest->z) nearest = Seen{is_skin, z};
    }
    return nearest;
  }

 private:
  struct Piece {
    glm::dvec3 a, b;
    bool is_skin;
  };
  std::vector<Piece> pieces_;
};

/// The edge of a lid under (above) its point: where the skin that is seen ends and the eyeball begins.
struct SeenEdge {
  glm::dvec3 place{0.0};
  double share = 0.0;  ///< of the way to the other lid's point
};

std::optional<SeenEdge> edge_beyond(const Subject& head, const SurfacePoint& point, const SurfacePoint& other) {
  const FrontColumn column(head, point.position.x);
  SeenEdge edge{point.position, 0.0};
  for (int k = 1; k < steps; ++k) {
    const double share = static_cast<double>(k) / steps;
    const double y = point.position.y + share * (other.position.y - point.position.y);
    const auto seen = column.at(y);
    if (!seen) return std::nullopt;
    if (!seen->is_skin) return edge;
    edge = {{point.position.x, y, seen->z}, share};
  }
  return std::nullopt;  // no eyeball is seen: the eye is closed
}

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
    const mpeg4::Opening& opening = mpeg4::openings[1 + eye];
    const SurfacePoint* const upper = point_named(points, opening.upper.front());
    const SurfacePoint* const lower = point_named(points, opening.lower.front());
    if (upper == nullptr || lower == nullptr || upper->position.y <= lower->position.y) continue;
    for (const bool is_upper : {true, false}) {
      const SurfacePoint& point = is_upper ? *upper : *lower;
      if (is_misplaced(head.misplaced, point.id)) continue;
      const auto edge = edge_beyond(head, point, is_upper ? *lower : *upper);
      if (!edge || edge->share < fold_share) continue;
      if (edge->share * (upper->position.y - lower->position.y) < least_fold * head.frame.eye_separation.value_or(0.0))
        continue;
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
                          edge->share, fold_share};
      findings.push_back(std::move(finding));
    }
  }
  return findings;
}

}  // namespace semblante
