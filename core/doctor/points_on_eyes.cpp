#include "core/anatomy/points_on_eyes.h"

#include <string>
#include <vector>

#include <glm/geometric.hpp>

#include "core/doctor/point_checks.h"
#include "core/doctor/words.h"

namespace semblante {
namespace {

/// "edge of the upper lid", "corner of the lids".
std::string place_in_words(const PointOnEye& on_eye) {
  const std::string name = to_string(on_eye.point.id);
  if (name == on_eye.lids->upper.front()) return "edge of the " + std::string(on_eye.lids->upper_name);
  if (name == on_eye.lids->lower.front()) return "edge of the " + std::string(on_eye.lids->lower_name);
  return "corner of the lids";
}

}  // namespace

std::vector<Finding> find_points_on_modelled_eyes(const Subject& head) {
  std::vector<Finding> findings;
  for (const PointOnEye& on_eye : head.on_eyes) {
    const glm::dvec3& edge = head.surface.positions[on_eye.edge.value()];
    const double distance = glm::distance(on_eye.point.position, edge);
    const VertexId to = head.surface.file_vertex_of[on_eye.edge.value()];
    const std::string place = place_in_words(on_eye);
    Finding finding;
    finding.code = FindingCode::point_on_eye;
    finding.severity = Severity::warning;
    finding.place.part = head.surface.part_of[on_eye.point.vertex.value()];
    finding.place.points.push_back(on_eye.point.id);
    finding.place.vertices.add(head.surface.file_vertex_of[on_eye.point.vertex.value()]);
    finding.place.position = on_eye.point.position;
    const double share = distance / head.frame.eye_separation.value_or(distance);
    finding.words = to_string(on_eye.point.id) + " lies on the eye instead of the " + place + ", " + percent(share) +
                    " of the eye distance away; the eye is one skin with its lids, so it moves along, and a blink does "
                    "not close over it";
    finding.move = Move{on_eye.point.id, to, edge};
    finding.remedy =
        "move " + to_string(on_eye.point.id) + " to vertex " + std::to_string(to.value()) + ", at the " + place;
    finding.measured = {"distance from the edge of the lids as a fraction of ES0", share, 0.0};
    findings.push_back(std::move(finding));
  }
  return findings;
}

}  // namespace semblante
