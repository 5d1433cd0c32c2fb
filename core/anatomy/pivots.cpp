#include "core/anatomy/pivots.h"

#include <algorithm>
#include <string_view>
#include <vector>

#include <glm/geometric.hpp>

#include "core/anatomy/part_roles.h"
#include "core/anatomy/point_lookup.h"
#include "core/geometry/sphere_fit.h"
#include "core/tables/openings.h"

namespace semblante {
namespace {

// In units of ES0. Measured on two heads of known anatomy, which agree within 5 %.
constexpr double eye_center_behind_pupil = 0.2;
constexpr double center_behind_corners = 0.05;
constexpr double spine_below_eyes = 0.74;
constexpr double spine_behind_eyes = 1.6;

struct Pupils {
  glm::dvec3 left, right;
};

std::optional<Pupils> find_pupils(const FeaturePointSet& points) {
  const FeaturePoint* const left = find_point(points, "3.5");
  const FeaturePoint* const right = find_point(points, "3.6");
  if (left == nullptr || right == nullptr) return std::nullopt;
  return Pupils{glm::dvec3(left->position), glm::dvec3(right->position)};
}

glm::dvec3 box_center(const Part& part) { return 0.5 * (glm::dvec3(part.box_min) + glm::dvec3(part.box_max)); }

/// How far the centre of an eye without a part of its own lies behind its pupil. The centre is behind the corners of
/// the lids too: a lid behind the axis on which it rolls would go into the head, as on large eyes of cartoons.
double depth_of_center(const FeaturePoint& pupil, double eye_separation, PartRole role, const FeaturePointSet& points) {
  double behind = eye_center_behind_pupil * eye_separation;
  for (const std::string_view name : mpeg4::lids_of(role == PartRole::left_eye ? 0 : 1).corners) {
    const FeaturePoint* const corner = find_point(points, name);
    if (corner == nullptr) continue;
    const double depth = static_cast<double>(pupil.position.z) - static_cast<double>(corner->position.z);
    behind = std::max(behind, depth + center_behind_corners * eye_separation);
  }
  return behind;
}

/// The ball without its protrusions (cornea, optic nerve): fitted again to the vertices near the first fit.
std::optional<Sphere> fit_ball(const Surface& surface, PartId part) {
  std::vector<glm::dvec3> positions;
  for (const SurfaceVertexId v : surface.members_of(part)) positions.push_back(surface.positions[v.value()]);
  std::optional<Sphere> ball = fit_sphere(positions);
  if (!ball) return ball;
  const double room = 1.5 * ball->rms_error;
  std::vector<glm::dvec3> near;
  for (const glm::dvec3& p : positions) {
    if (std::abs(glm::distance(p, ball->center) - ball->radius) <= room) near.push_back(p);
  }
  const std::optional<Sphere> refined = near.size() * 2 >= positions.size() ? fit_sphere(near) : std::nullopt;
  if (refined) ball = refined;
  return ball;
}

/// Flat: only an iris. A rotation about its own centre would only tilt it.
bool is_flat(const Part& part) { return part.box_max.z - part.box_min.z < 0.4F * (part.box_max.x - part.box_min.x); }

}  // namespace

std::optional<Sphere> round_eyeball(const Surface& surface, std::span<const Part> parts, PartRole role) {
  const std::optional<PartId> id = largest_part(parts, role);
  if (!id) return std::nullopt;
  const Part& part = parts[id->value()];
  if (is_flat(part)) return std::nullopt;
  const std::optional<Sphere> ball = fit_ball(surface, *id);
  const double width = static_cast<double>(part.box_max.x) - static_cast<double>(part.box_min.x);
  const bool is_round =
      ball && ball->rms_error < 0.1 * ball->radius && glm::distance(ball->center, box_center(part)) < width;
  return is_round ? ball : std::nullopt;
}

glm::vec3 eye_pivot(const Surface& surface, std::span<const Part> parts, PartRole role, const FeaturePointSet& points) {
  const FeaturePoint* const pupil = find_point(points, role == PartRole::left_eye ? "3.5" : "3.6");
  const std::optional<Pupils> pupils = find_pupils(points);
  const double separation = pupils ? glm::distance(pupils->left, pupils->right) : 0.0;
  const double behind = eye_center_behind_pupil * separation;

  const std::optional<PartId> id = largest_part(parts, role);
  if (!id) {
    if (pupil == nullptr) return glm::vec3(0.0F);
    return pupil->position - glm::vec3(0.0F, 0.0F, pupils ? depth_of_center(*pupil, separation, role, points) : 0.0);
  }

  const Part& part = parts[id->value()];
  const glm::dvec3 center = box_center(part);
  if (is_flat(part)) return glm::vec3(center - glm::dvec3(0.0, 0.0, behind));
  const std::optional<Sphere> ball = round_eyeball(surface, parts, role);
  return glm::vec3(ball ? ball->center : center);
}

glm::vec3 head_pivot(std::span<const Part> parts, const FeaturePointSet& points, const NeckJoints& joints) {
  if (const FeaturePoint* const marked = find_point(points, "7.1")) return marked->position;
  if (joints.head) return joints.head->position;
  if (const std::optional<Pupils> pupils = find_pupils(points)) {
    const double es = glm::distance(pupils->left, pupils->right);
    const glm::dvec3 middle = 0.5 * (pupils->left + pupils->right);
    return glm::vec3(middle - glm::dvec3(0.0, spine_below_eyes * es, spine_behind_eyes * es));
  }
  const std::optional<PartId> skin = largest_part(parts, PartRole::skin);
  if (!skin) return glm::vec3(0.0F);
  // For a head cut at the neck: a little below its middle and behind it.
  constexpr glm::dvec3 place(0.5, 0.45, 0.4);
  const glm::dvec3 low(parts[skin->value()].box_min);
  const glm::dvec3 high(parts[skin->value()].box_max);
  return glm::vec3(low + place * (high - low));
}

}  // namespace semblante
