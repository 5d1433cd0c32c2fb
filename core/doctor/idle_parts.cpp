#include <algorithm>
#include <array>
#include <limits>
#include <set>
#include <span>
#include <string>
#include <vector>

#include <glm/geometric.hpp>

#include "core/anatomy/part_roles.h"
#include "core/anatomy/point_lookup.h"
#include "core/anatomy/role_by_name.h"
#include "core/doctor/part_checks.h"
#include "core/doctor/words.h"
#include "core/geometry/nearest_point.h"

namespace semblante {
namespace {

/// A piece within this distance of a point of the face, in ES0, should move with it; 6 mm on a human face.
constexpr double beside_a_point = 0.10;
/// A part close to this fraction of a face's points is a second face; hair and glasses are close to fewer.
constexpr double share_of_a_face = 0.5;

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

/// The distances of a part to the points that move the skin.
struct Nearness {
  double distance = std::numeric_limits<double>::infinity();  ///< smallest distance, model units
  std::size_t point = 0;                                      ///< index of the nearest point
  glm::dvec3 at{0.0};
  std::set<std::size_t> beside;  ///< points within reach
};

Nearness nearness_of(const Surface& surface, PartId part, NearestPoint& points, double reach) {
  Nearness near;
  for (const SurfaceVertexId v : surface.members_of(part)) {
    const auto hit = points.nearest(surface.positions[v.value()]);
    if (hit.distance <= reach) near.beside.insert(hit.index);
    if (hit.distance >= near.distance) continue;
    near.distance = hit.distance;
    near.point = hit.index;
    near.at = surface.positions[v.value()];
  }
  return near;
}

Finding about(const Subject& head, std::size_t part, FindingCode code, FeaturePointId point, const glm::dvec3& at) {
  Finding finding;
  finding.code = code;
  finding.severity = Severity::warning;
  finding.place.part = PartId(static_cast<std::uint32_t>(part));
  finding.place.points.push_back(point);
  finding.place.vertices = members(head, part);
  finding.place.position = at;
  return finding;
}

/// Whether a person said so, or its name: hair and glasses lie in the face and follow the head alone.
bool is_meant_to_stay(const Part& part) { return part.role_by_user || is_rigid_name(part.name); }

struct IdlePart {
  std::size_t part;
  FeaturePointId point;  ///< the nearest
  glm::dvec3 at;
  double distance;  ///< to it, in ES0
};

/// One finding for each of a few parts, one for all of many, at the nearest of them.
void tell_idle_parts(const Subject& head, const std::vector<IdlePart>& idle, std::vector<Finding>& out) {
  constexpr std::size_t most_alone = 2;
  constexpr std::size_t most_named = 4;
  const auto& parts = head.rig.parts;
  const auto tell = [&](std::span<const IdlePart> told) {
    const IdlePart& nearest = *std::min_element(
        told.begin(), told.end(), [](const IdlePart& a, const IdlePart& b) { return a.distance < b.distance; });
    Finding finding = about(head, nearest.part, FindingCode::idle_part, nearest.point, nearest.at);
    std::string names;
    std::size_t vertices = 0;
    for (std::size_t i = 0; i < told.size(); ++i) {
      vertices += parts[told[i].part].vertex_count;
      if (i < most_named) names += (i == 0 ? "" : ", ") + called(parts, told[i].part);
    }
    const std::string size = count_of(vertices, "vertex", "vertices");
    finding.words = told.size() == 1
                        ? names + ", " + size + ", is in the moving face close to " + to_string(nearest.point) +
                              ", but no point influences it and it has no role; it stays while the skin under it moves"
                        : std::to_string(told.size()) + " parts: " + names + (told.size() > most_named ? ", ..." : "") +
                              ", " + size + ", are in the moving face, the nearest close to " +
                              to_string(nearest.point) +
                              ", but no point influences them and they have no role; they stay while the skin under "
                              "them moves";
    finding.remedy =
        "give the part a role (attached, if it sits on the skin), join it to the skin, or mark points on it";
    finding.measured = {"distance to the point as a fraction of ES0", nearest.distance, beside_a_point};
    out.push_back(std::move(finding));
  };
  if (idle.size() > most_alone) {
    tell(idle);
  } else {
    for (const IdlePart& part : idle) tell({&part, 1});
  }
}

void find_strangers(const Subject& head, std::vector<Finding>& out) {
  if (!head.frame.eye_separation) return;
  std::vector<glm::dvec3> places;
  std::vector<FeaturePointId> ids;
  std::set<PartId> with_points;
  for (const SurfacePoint& point : surface_points(head.surface, head.rig.points)) {
    if (!moves_with_the_skin(point.id)) continue;
    places.push_back(point.position);
    ids.push_back(point.id);
    with_points.insert(head.surface.part_of[point.vertex.value()]);
  }
  if (places.empty()) return;
  NearestPoint nearest(places);
  const double reach = beside_a_point * *head.frame.eye_separation;
  const auto& parts = head.rig.parts;
  std::vector<IdlePart> idle;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const PartId part(static_cast<std::uint32_t>(p));
    if (parts[p].triangle_count == 0 || with_points.contains(part)) continue;
    const Nearness near = nearness_of(head.surface, part, nearest, reach);
    const double share = static_cast<double>(near.beside.size()) / static_cast<double>(ids.size());
    if (share >= share_of_a_face) {
      Finding finding = about(head, p, FindingCode::second_skin, ids[near.point], near.at);
      finding.words = called(parts, p) + " is close to " + std::to_string(near.beside.size()) + " of the face's " +
                      std::to_string(ids.size()) +
                      " points, like a second skin or a second level of detail; the points are not on it, so it "
                      "shows through the moving face";
      finding.remedy = "export the model with one skin only";
      finding.measured = {"fraction of the face's points close to it", share, share_of_a_face};
      out.push_back(std::move(finding));
    } else if (parts[p].role == PartRole::rest && near.distance <= reach && !is_meant_to_stay(parts[p])) {
      idle.push_back({p, ids[near.point], near.at, near.distance / *head.frame.eye_separation});
    }
  }
  tell_idle_parts(head, idle, out);
}

struct Eye {
  PartRole role;
  std::string_view name, pupil, faps;
};
constexpr std::array<Eye, 2> eyes = {Eye{PartRole::left_eye, "left", "3.5", "23, 25 and 27"},
                                     Eye{PartRole::right_eye, "right", "3.6", "24, 26 and 28"}};

Finding still_eye(const Subject& head, const Eye& eye) {
  Finding finding;
  finding.code = FindingCode::eye_cannot_turn;
  finding.severity = Severity::note;
  finding.place.points.push_back(*parse_feature_point(eye.pupil));
  if (const FeaturePoint* const pupil = find_point(head.rig.points, eye.pupil))
    finding.place.position = glm::dvec3(pupil->position);
  finding.words =
      "no part is the " + std::string(eye.name) + " eyeball, so FAPs " + std::string(eye.faps) + " have no effect";
  finding.remedy =
      "give the eyeball's part this role, and separate it from the skin before if both are joined; an eye painted "
      "on the skin cannot rotate";
  return finding;
}

/// An eyeball that a converter has welded to its lids, where it merged near vertices.
Finding welded_eye(const Subject& head, const Eye& eye, const ModelledEye& modelled) {
  Finding finding = still_eye(head, eye);
  finding.code = FindingCode::eye_welded;
  finding.severity = Severity::warning;
  VertexSample vertices;
  for (const SurfaceVertexId v : modelled.held) vertices.add(head.surface.file_vertex_of[v.value()]);
  finding.place.part = head.surface.part_of[modelled.held.front().value()];
  finding.place.vertices = std::move(vertices);
  if (!finding.place.position) finding.place.position = 0.5 * (modelled.upper + modelled.lower);
  finding.words = "the " + std::string(eye.name) + " eyeball is welded to the lids: it cannot turn, so FAPs " +
                  std::string(eye.faps) +
                  " have no effect, and lids that close over it leave thin cracks where both share vertices";
  finding.remedy =
      "split the vertices that the eyeball shares with the lids, or export the head without merging near vertices; "
      "then the eyeball is a part of its own";
  return finding;
}

void find_still_eyes(const Subject& head, std::vector<Finding>& out) {
  for (std::size_t k = 0; k < eyes.size(); ++k) {
    if (has_part(head.rig.parts, eyes[k].role)) continue;
    const auto& modelled = head.modelled_eyes[k];
    out.push_back(modelled && modelled->is_welded ? welded_eye(head, eyes[k], *modelled) : still_eye(head, eyes[k]));
  }
}

}  // namespace

std::vector<Finding> find_idle_parts(const Subject& head) {
  std::vector<Finding> findings;
  find_strangers(head, findings);
  find_still_eyes(head, findings);
  return findings;
}

}  // namespace semblante
