#include "core/propose/mouth_and_eyes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <glm/geometric.hpp>

#include "core/anatomy/part_roles.h"

namespace semblante {
namespace {

// In ES0, as the coordinates of FaceSurface.
constexpr double beside = 0.03;     ///< maximum distance from the pupil expected by proportions for a vertex there
constexpr double believable = 0.2;  ///< maximum distance from the pupil expected by proportions
constexpr double cornea = 0.12;     ///< radius of the cornea seen from the front

}  // namespace

std::optional<Sphere> find_eyeball(const FaceSurface& face, std::span<const Part> parts, PartRole eye) {
  const std::optional<PartId> largest = largest_part(parts, eye);
  if (!largest) return std::nullopt;
  std::vector<glm::dvec3> places;
  for (const SurfaceVertexId v : face.surface().members_of(*largest)) places.push_back(face.at(v.value()));
  const std::optional<Sphere> ball = fit_sphere(places);
  constexpr double roundness = 0.15;
  return ball && ball->rms_error < roundness * ball->radius ? ball : std::nullopt;
}

glm::dvec3 find_pupil(const FaceSurface& face, std::span<const Part> parts, PartRole eye, const glm::dvec3& guess) {
  if (const std::optional<Sphere> ball = find_eyeball(face, parts, eye)) {
    const auto off_axis = [&](std::uint32_t v) {
      return std::hypot(face.at(v).x - ball->center.x, face.at(v).y - ball->center.y);
    };
    double front = -std::numeric_limits<double>::infinity();
    for (const std::uint32_t v : face.with_role(eye)) {
      if (face.at(v).z >= ball->center.z && off_axis(v) <= cornea) front = std::max(front, face.at(v).z);
    }
    const glm::dvec3 pupil(ball->center.x, ball->center.y, front);
    if (std::isfinite(front) && glm::distance(pupil, guess) < believable) return pupil;
  }
  glm::dvec3 nearest = guess;
  double least = beside;
  for (std::size_t role = 0; role < part_role_names.size(); ++role) {
    for (const std::uint32_t v : face.with_role(static_cast<PartRole>(role))) {
      const double away = glm::distance(face.at(v), guess);
      if (away >= least) continue;
      least = away;
      nearest = face.at(v);
    }
  }
  return nearest;
}

bool is_tongue_alone(const FaceSurface& face) {
  constexpr double tallest = 0.55;  // a tongue in one piece with both gums is about 0.7 high
  const auto& tongue = face.with_role(PartRole::tongue);
  if (tongue.empty()) return false;
  const auto [low, high] = std::minmax_element(
      tongue.begin(), tongue.end(), [&](std::uint32_t a, std::uint32_t b) { return face.at(a).y < face.at(b).y; });
  return face.at(*high).y - face.at(*low).y < tallest;
}

glm::dvec3 middle_of_tongue(const FaceSurface& face, const MirrorPlane& plane, const glm::dvec3& tip,
                            const glm::dvec3& guess) {
  constexpr double believable_depth = 0.6;
  std::vector<glm::dvec3> middle;
  double rear = tip.z;
  for (const std::uint32_t v : face.with_role(PartRole::tongue)) {
    if (!face.is_on(plane, v)) continue;
    middle.push_back(face.at(v));
    rear = std::min(rear, face.at(v).z);
  }
  const double depth = 0.5 * (tip.z + rear);
  if (middle.empty() || std::abs(depth - guess.z) > believable_depth) return guess;
  // The top at that depth: the higher of the nearest vertices.
  const auto off = [depth](const glm::dvec3& p) { return std::abs(p.z - depth) - 0.5 * p.y; };
  return *std::min_element(middle.begin(), middle.end(),
                           [&](const glm::dvec3& a, const glm::dvec3& b) { return off(a) < off(b); });
}

std::optional<std::uint32_t> border_of_tongue(const FaceSurface& face, const glm::dvec3& middle, double side) {
  constexpr double same_depth = 0.06;
  std::optional<std::uint32_t> border;
  for (const std::uint32_t v : face.with_role(PartRole::tongue)) {
    if (std::abs(face.at(v).z - middle.z) > same_depth) continue;
    if (!border || side * face.at(v).x > side * face.at(*border).x) border = v;
  }
  return border;
}

}  // namespace semblante
