#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <string>
#include <vector>

#include <glm/geometric.hpp>

#include "core/anatomy/front_points.h"
#include "core/anatomy/part_roles.h"
#include "core/anatomy/point_lookup.h"
#include "core/anatomy/role_by_name.h"
#include "core/doctor/point_checks.h"
#include "core/doctor/words.h"
#include "core/geometry/triangle_shape.h"

namespace semblante {
namespace {

/// If this many points are on another part than the skin, the skin was cut; fewer are misplaced points.
constexpr std::size_t points_of_a_piece = 3;

Finding at_point(const Subject& head, const SurfacePoint& point, FindingCode code, Severity severity) {
  Finding finding;
  finding.code = code;
  finding.severity = severity;
  finding.place.part = head.surface.part_of[point.vertex.value()];
  finding.place.points.push_back(point.id);
  finding.place.vertices.add(head.surface.file_vertex_of[point.vertex.value()]);
  finding.place.position = point.position;
  return finding;
}

void find_shared_vertices(const Subject& head, std::span<const SurfacePoint> points, std::vector<Finding>& out) {
  std::map<SurfaceVertexId, std::vector<SurfacePoint>> at;
  for (const SurfacePoint& point : points) at[point.vertex].push_back(point);
  for (const auto& [vertex, together] : at) {
    if (together.size() < 2) continue;
    Finding finding = at_point(head, together.front(), FindingCode::points_on_one_vertex, Severity::warning);
    for (std::size_t i = 1; i < together.size(); ++i) finding.place.points.push_back(together[i].id);
    finding.words =
        list_of(finding.place.points) + " are on one vertex; it follows their mean, so none of them moves fully";
    finding.remedy = "move each to its own vertex, or leave the less important ones unmarked";
    out.push_back(std::move(finding));
  }
}

std::string name_of(const Part& part) { return part.name.empty() ? "" : " \"" + part.name + "\""; }

using PointsOfParts = std::map<std::size_t, std::vector<SurfacePoint>>;

/// The skin part with the most points.
std::size_t main_part(const PointsOfParts& of_parts) {
  return std::max_element(of_parts.begin(), of_parts.end(),
                          [](const auto& a, const auto& b) { return a.second.size() < b.second.size(); })
      ->first;
}

/// Whether all points of a part are points of the lids: lids may be separate parts. A single point says so only with
/// the part's name, because it may be on a lash.
bool is_a_lid(const std::vector<SurfacePoint>& points, const Part& part) {
  return (points.size() >= 2 || is_lid_name(part.name)) &&
         std::all_of(points.begin(), points.end(), [](const SurfacePoint& p) { return group_of(p.id) == 3; });
}

std::string role_of(const Part& part) {
  std::string role(part_role_names[static_cast<std::size_t>(part.role)]);
  std::replace(role.begin(), role.end(), '_', ' ');
  return role;
}

void tell_wrong_part(const Subject& head, const SurfacePoint& point, const std::string& belongs,
                     std::vector<Finding>& out) {
  const std::size_t at = head.surface.part_of[point.vertex.value()].value();
  Finding finding = at_point(head, point, FindingCode::point_on_wrong_part, Severity::error);
  finding.words = to_string(point.id) + " belongs " + belongs + ", but its vertex is on part " + std::to_string(at) +
                  name_of(head.rig.parts[at]) + " (" + role_of(head.rig.parts[at]) + "); the face does not follow it";
  finding.remedy = "move it to the nearest vertex " + belongs;
  out.push_back(std::move(finding));
}

void find_skin_points_elsewhere(const Subject& head, std::span<const SurfacePoint> points, std::vector<Finding>& out) {
  PointsOfParts of_parts;
  for (const SurfacePoint& point : points) {
    // Ears are often separate pieces, and points on them are correct.
    if (is_skin_point(point.id) && group_of(point.id) != 10)
      of_parts[head.surface.part_of[point.vertex.value()].value()].push_back(point);
  }
  if (of_parts.size() < 2) return;
  const std::size_t main = main_part(of_parts);
  for (const auto& [part, there] : of_parts) {
    if (part == main || is_a_lid(there, head.rig.parts[part])) continue;
    if (there.size() < points_of_a_piece) {
      for (const SurfacePoint& point : there) tell_wrong_part(head, point, "on the skin of the face", out);
      continue;
    }
    Finding finding = at_point(head, there.front(), FindingCode::skin_in_pieces, Severity::error);
    for (std::size_t i = 1; i < there.size(); ++i) finding.place.points.push_back(there[i].id);
    finding.words = "part " + std::to_string(part) + name_of(head.rig.parts[part]) + " with " +
                    list_of(finding.place.points) + " is a piece of the face that is not connected to part " +
                    std::to_string(main) + name_of(head.rig.parts[main]) +
                    ", where the other points are; no movement crosses from one to the other, and the skin tears";
    finding.remedy = "join the pieces: merge vertices by distance along the border between them";
    out.push_back(std::move(finding));
  }
}

void find_wrong_parts(const Subject& head, std::span<const SurfacePoint> points, std::vector<Finding>& out) {
  const auto& parts = head.rig.parts;
  find_skin_points_elsewhere(head, points, out);
  for (const SurfacePoint& point : points) {
    if (head.surface.steps_from(point.vertex).empty()) {
      Finding finding = at_point(head, point, FindingCode::point_on_no_surface, Severity::error);
      finding.words = to_string(point.id) + " is on a vertex that no triangle uses; it has no effect";
      finding.remedy = "move it to the nearest vertex of the face";
      out.push_back(std::move(finding));
      continue;
    }
    if (parts[head.surface.part_of[point.vertex.value()].value()].role != PartRole::skin) continue;
    const std::string name = to_string(point.id);
    // Without an eyeball or tongue the point is correctly on the skin.
    if (name == "3.5" && has_part(parts, PartRole::left_eye)) tell_wrong_part(head, point, "on the left eyeball", out);
    if (name == "3.6" && has_part(parts, PartRole::right_eye))
      tell_wrong_part(head, point, "on the right eyeball", out);
    if (group_of(point.id) == 6 && has_part(parts, PartRole::tongue))
      tell_wrong_part(head, point, "on the tongue", out);
  }
}

void find_points_on_the_inside(const Subject& head, std::span<const SurfacePoint> points, std::vector<Finding>& out) {
  std::map<std::uint32_t, glm::dvec3> normals;
  for (const SurfacePoint& point : points) {
    if (is_on_front(point.id)) normals[point.vertex.value()] = glm::dvec3(0.0);
  }
  std::vector<bool> wanted(head.surface.vertex_count(), false);
  for (const auto& [vertex, normal] : normals) wanted[vertex] = true;
  for (const Triangle& triangle : head.model.triangles) {
    std::array<std::uint32_t, 3> c{};
    for (std::size_t k = 0; k < 3; ++k) c[k] = head.surface.surface_of[triangle[k]].value();
    if (!wanted[c[0]] && !wanted[c[1]] && !wanted[c[2]]) continue;
    const auto& p = head.surface.positions;
    const glm::dvec3 normal = area_vector(p[c[0]], p[c[1]], p[c[2]]);
    for (const std::uint32_t corner : c)
      if (wanted[corner]) normals[corner] += normal;
  }
  std::vector<Finding> findings;
  for (const SurfacePoint& point : points) {
    const auto normal = normals.find(point.vertex.value());
    if (normal == normals.end() || glm::length(normal->second) == 0.0) continue;
    const double towards = glm::dot(glm::normalize(normal->second), head.frame.forward);
    if (towards > faces_away) continue;
    Finding finding = at_point(head, point, FindingCode::point_on_inside, Severity::warning);
    finding.words =
        to_string(point.id) +
        " is on a surface that faces into the head, such as the inner wall of a double one or a mouth bag; the "
        "visible skin does not follow it";
    finding.remedy = "move it to the vertex in front of it, on the outside";
    finding.measured = {"cosine between the surface's normal and the outward direction of the face", towards,
                        faces_away};
    findings.push_back(std::move(finding));
  }
  // If most points are like this, the face is inside out, which is a finding of the mesh.
  if (findings.size() * 2 < normals.size()) std::move(findings.begin(), findings.end(), std::back_inserter(out));
}

void find_points_on_other_rim(const Subject& head, std::vector<Finding>& out) {
  for (const MisplacedRimPoint& misplaced : head.misplaced) {
    const auto& [point, opening, is_upper, nearest] = misplaced;
    Finding finding = at_point(head, point, FindingCode::point_on_other_rim, Severity::error);
    const std::string own(is_upper ? opening->upper_name : opening->lower_name);
    const std::string other(is_upper ? opening->lower_name : opening->upper_name);
    finding.words = to_string(point.id) + " lies on the ";
    finding.words.append(other).append(", but it is a point of the ").append(own).append("; the ").append(other);
    finding.words.append(" follows both, and the ").append(opening->is_mouth ? "mouth" : "eye");
    finding.words += " cannot open or close cleanly";
    const VertexId vertex = head.surface.file_vertex_of[nearest.value()];
    finding.move = Move{point.id, vertex, head.surface.positions[nearest.value()]};
    finding.remedy =
        "move " + to_string(point.id) + " to vertex " + std::to_string(vertex.value()) + ", the nearest of the " + own;
    out.push_back(std::move(finding));
  }
}

}  // namespace

std::vector<Finding> find_points_on_wrong_surface(const Subject& head) {
  std::vector<Finding> findings;
  const std::vector<SurfacePoint> points = surface_points(head.surface, head.rig.points);
  find_wrong_parts(head, points, findings);
  find_shared_vertices(head, points, findings);
  find_points_on_the_inside(head, points, findings);
  find_points_on_other_rim(head, findings);
  return findings;
}

}  // namespace semblante
