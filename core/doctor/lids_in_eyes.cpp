#include <cstddef>
#include <optional>
#include <string>
#include <utility>

#include <glm/geometric.hpp>

#include "core/anatomy/lid_edge.h"
#include "core/anatomy/part_roles.h"
#include "core/anatomy/pivots.h"
#include "core/doctor/part_checks.h"
#include "core/doctor/words.h"

namespace semblante {
namespace {

/// Of the eyeball's radius. Lids of good heads touch the ball or dip in it by 0.03 at most; the kernel takes what is
/// deeper for the inside of a lid.
constexpr double deep_in_eye = 0.04;

struct Depth {
  SurfaceVertexId vertex;
  double share;  ///< of the ball's radius
};

/// The deepest vertex of an edge but for its corners, which may lie beside the ball.
std::optional<Depth> deepest(const Surface& surface, const LidEdge& edge, const Sphere& ball) {
  std::optional<Depth> result;
  for (const auto& path : edge.to_corner) {
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
      const double share = 1.0 - glm::distance(surface.positions[path[i].value()], ball.center) / ball.radius;
      if (!result || share > result->share) result = Depth{path[i], share};
    }
  }
  return result;
}

Finding lid_in_eye(const Subject& head, std::size_t eye, const LidEdge& edge, bool is_upper, const Depth& depth) {
  Finding finding;
  finding.code = FindingCode::lids_in_eye;
  finding.severity = Severity::warning;
  finding.place.points.push_back(edge.middle.id);
  finding.place.vertices.add(head.surface.file_vertex_of[depth.vertex.value()]);
  finding.place.position = head.surface.positions[depth.vertex.value()];
  finding.words = "the edge of the " + std::string(is_upper ? "upper" : "lower") + " lid of the " +
                  (eye == 0 ? "left" : "right") + " eye lies in the eyeball, " + percent(depth.share) +
                  " of its radius deep: the eyeball is seen through the lid, also when it closes";
  finding.remedy =
      "move the eyeball back, make it smaller or bring the lid forward, until the whole edge lies before the eyeball";
  finding.measured = {"depth of the edge as a fraction of the eyeball's radius", depth.share, deep_in_eye};
  return finding;
}

}  // namespace

std::vector<Finding> find_lids_in_eyes(const Subject& head) {
  std::vector<Finding> findings;
  for (std::size_t eye = 0; eye < 2; ++eye) {
    const std::optional<Sphere> ball = round_eyeball(head.surface, head.rig.parts, eyeball_role(eye));
    const auto edges = find_eye_edges(head.surface, head.points_in_place, eye, head.rig.parts);
    if (!ball || !edges) continue;
    for (const bool is_upper : {true, false}) {
      const LidEdge& edge = is_upper ? edges->upper : edges->lower;
      const auto depth = deepest(head.surface, edge, *ball);
      if (depth && depth->share > deep_in_eye) findings.push_back(lid_in_eye(head, eye, edge, is_upper, *depth));
    }
  }
  return findings;
}

}  // namespace semblante
