#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/doctor/part_checks.h"
#include "core/doctor/words.h"
#include "core/geometry/nearest_point.h"
#include "core/parametrize/part_roles.h"
#include "core/parametrize/point_lookup.h"

namespace semblante {
namespace {

/// A piece this near to a point of the moving face, of ES0, is part of what should move; 6 mm on a human face.
constexpr double beside_a_point = 0.10;
/// Two parts are the same thing twice when one has this share of the other's vertices and fills this share of its box.
constexpr double least_vertices = 0.25;
constexpr double least_extent = 0.7;

std::string called(const std::vector<Part>& parts, std::size_t index) {
  return "part " + std::to_string(index) + (parts[index].name.empty() ? "" : " \"" + parts[index].name + "\"");
}

VertexSample members(const Subject& head, std::size_t part) {
  VertexSample sample;
  for (const SurfaceVertexId v : head.surface.members_of(PartId(static_cast<std::uint32_t>(part))))
    sample.add(head.surface.file_vertex_of[v.value()]);
  return sample;
}

bool moves_with_the_skin(FeaturePointId id) { return is_skin_point(id) && group_of(id) != 10; }

void find_islands(const Subject& head, std::vector<Finding>& out) {
  if (!head.frame.eye_separation) return;
  std::vector<glm::dvec3> places;
  std::vector<FeaturePointId> ids;
  for (const SurfacePoint& point : surface_points(head.surface, head.rig.points)) {
    if (!moves_with_the_skin(point.id)) continue;
    places.push_back(point.position);
    ids.push_back(point.id);
  }
  if (places.empty()) return;
  const NearestPoint nearest(places);
  const auto& parts = head.rig.parts;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    if (parts[p].role != PartRole::rest || parts[p].triangle_count == 0) continue;
    double least = std::numeric_limits<double>::infinity();
    std::size_t point = 0;
    glm::dvec3 at(0.0);
    for (const SurfaceVertexId v : head.surface.members_of(PartId(static_cast<std::uint32_t>(p)))) {
      const auto hit = nearest.nearest(head.surface.positions[v.value()]);
      if (hit.distance >= least) continue;
      least = hit.distance;
      point = hit.index;
      at = head.surface.positions[v.value()];
    }
    const double share = least / *head.frame.eye_separation;
    if (share > beside_a_point) continue;
    Finding finding;
    finding.code = FindingCode::idle_part;
    finding.severity = Severity::warning;
    finding.place.part = PartId(static_cast<std::uint32_t>(p));
    finding.place.points.push_back(ids[point]);
    finding.place.vertices = members(head, p);
    finding.place.position = at;
    finding.words = called(parts, p) + ", " + count_of(parts[p].vertex_count, "vertex", "vertices") +
                    ", lies in the moving face beside " + to_string(ids[point]) +
                    ", but no point reaches it and it has no role; it stays while the skin moves away under it";
    finding.remedy =
        "give the part a role (attached, if it sits on the skin), join it to the skin, or mark points on it";
    finding.measured = {"distance to the point as a share of ES0", share, beside_a_point};
    out.push_back(std::move(finding));
  }
}

void find_second_skin(const Subject& head, std::vector<Finding>& out) {
  const auto& parts = head.rig.parts;
  std::size_t main = parts.size();
  for (std::size_t p = 0; p < parts.size(); ++p) {
    if (parts[p].role != PartRole::skin) continue;
    if (main == parts.size() || parts[p].vertex_count > parts[main].vertex_count) main = p;
  }
  if (main == parts.size()) return;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    if (p == main || parts[p].vertex_count < least_vertices * parts[main].vertex_count) continue;
    const glm::vec3 low = glm::max(parts[p].box_min, parts[main].box_min);
    const glm::vec3 high = glm::min(parts[p].box_max, parts[main].box_max);
    const glm::vec3 size = parts[main].box_max - parts[main].box_min;
    if (glm::any(glm::lessThan(high - low, static_cast<float>(least_extent) * size))) continue;
    Finding finding;
    finding.code = FindingCode::second_skin;
    finding.severity = Severity::warning;
    finding.place.part = PartId(static_cast<std::uint32_t>(p));
    finding.place.vertices = members(head, p);
    finding.place.position = 0.5 * (glm::dvec3(parts[p].box_min) + glm::dvec3(parts[p].box_max));
    finding.words = called(parts, p) + " fills the same space as " + called(parts, main) +
                    ", as a second skin or a second level of detail does; only one of them moves, and the other shows "
                    "through it";
    finding.remedy = "export the model with one skin only";
    out.push_back(std::move(finding));
  }
}

void find_still_eyes(const Subject& head, std::vector<Finding>& out) {
  struct Eye {
    PartRole role;
    std::string_view name, pupil, faps;
  };
  for (const Eye& eye : {Eye{PartRole::left_eye, "left", "3.5", "23, 25 and 27"},
                         Eye{PartRole::right_eye, "right", "3.6", "24, 26 and 28"}}) {
    if (std::any_of(head.rig.parts.begin(), head.rig.parts.end(), [&](const Part& p) { return p.role == eye.role; }))
      continue;
    Finding finding;
    finding.code = FindingCode::eye_cannot_turn;
    finding.severity = Severity::note;
    finding.place.points.push_back(*parse_feature_point(eye.pupil));
    if (const FeaturePoint* const pupil = find_point(head.rig.points, eye.pupil))
      finding.place.position = glm::dvec3(pupil->position);
    finding.words =
        "no part is the " + std::string(eye.name) + " eyeball, so FAPs " + std::string(eye.faps) + " turn nothing";
    finding.remedy = "give the eyeball's part that role; where the eye is painted on the skin there is nothing to turn";
    out.push_back(std::move(finding));
  }
}

}  // namespace

std::vector<Finding> find_idle_parts(const Subject& head) {
  std::vector<Finding> findings;
  find_second_skin(head, findings);
  find_islands(head, findings);
  find_still_eyes(head, findings);
  return findings;
}

}  // namespace semblante
