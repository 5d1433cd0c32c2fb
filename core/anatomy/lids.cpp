#include "core/anatomy/lids.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <glm/geometric.hpp>

#include "core/anatomy/part_roles.h"
#include "core/anatomy/slanted_opening.h"
#include "core/anatomy/smooth_step.h"

namespace semblante {
namespace {

/// The slit in the middle, radians. Beyond `greatest_overlap` and `greatest_slit` the points are not those of lids, or
/// the pivot is not behind them.
constexpr double greatest_overlap = 0.2;
constexpr double greatest_slit = 2.4;
/// Lids follow the gaze from the first slit on, from the second one as far as they ever do: those of somebody asleep do
/// not.
constexpr double closed_slit = 0.05;
constexpr double open_slit = 0.3;

/// Radii at one place of the front may differ by this share, and the front still counts as round. It is less than the
/// clearance of lids from the ball.
constexpr double unround = 0.01;

/// The angle of a place about the line through the pivot along x, from straight ahead upwards.
double angle_of(const glm::dvec3& p, const glm::dvec3& pivot) { return std::atan2(p.y - pivot.y, p.z - pivot.z); }

/// Places on the edges of the eyeball, as coordinate of the profile and distance from the pivot.
struct Profile {
  std::array<double, Lids::ball_places> sum{}, weight{}, greatest{};

  void add(const glm::dvec3& d, const glm::dvec3& pole) {
    const double distance = glm::length(d);
    if (!(distance > 0.0)) return;
    const double cosine = glm::dot(d, pole) / distance;
    if (cosine < 0.0) return;
    const double at = std::sqrt(std::max(0.0, 1.0 - cosine)) * (Lids::ball_places - 1);
    const auto k = std::min(static_cast<std::size_t>(at), Lids::ball_places - 2);
    for (const std::size_t place : {k, k + 1}) {
      const double share = 1.0 - std::abs(at - static_cast<double>(place));
      sum[place] += share * distance;
      weight[place] += share;
      if (share >= 0.5) greatest[place] = std::max(greatest[place], distance);
    }
  }

  /// Places that no edge crosses have this distance.
  void fill(double distance) {
    for (std::size_t k = 0; k < weight.size(); ++k) {
      if (weight[k] > 0.0) continue;
      sum[k] = greatest[k] = distance;
      weight[k] = 1.0;
    }
  }

  /// The distance at each place; places that no edge crosses are interpolated. All zero for what is no ball: a
  /// disc or a shell ends before the equator.
  [[nodiscard]] std::array<float, Lids::ball_places> radii() const {
    std::array<float, Lids::ball_places> result{};
    constexpr double least = 0.05;  // a weight below says little
    std::vector<std::size_t> known;
    for (std::size_t k = 0; k < weight.size(); ++k) {
      if (weight[k] > least) known.push_back(k);
    }
    if (known.size() < 3 || known.back() < 3 * weight.size() / 4) return result;
    for (std::size_t k = 0; k < result.size(); ++k) {
      const auto after = std::lower_bound(known.begin(), known.end(), k);
      const std::size_t b = after == known.end() ? known.back() : *after;
      const std::size_t a = after == known.begin() ? known.front() : b == k ? k : *(after - 1);
      const double t = a == b ? 0.0 : (static_cast<double>(k) - static_cast<double>(a)) / static_cast<double>(b - a);
      result[k] = static_cast<float>(radius(a) + t * (radius(b) - radius(a)));
    }
    return result;
  }

 private:
  /// The mean distance; on the front the greatest one (less `unround`) if that is more, so that lids clear what stands
  /// out. Not at the sides: the greatest distance of an eyeball that is wider than high would move the corners of lids.
  [[nodiscard]] double radius(std::size_t place) const {
    const double mean = sum[place] / weight[place];
    return place < Lids::ball_places / 2 ? std::max(mean, (1.0 - unround) * greatest[place]) : mean;
  }
};

void add_edges(const Surface& surface, SurfaceVertexId vertex, const glm::dvec3& pivot, const glm::dvec3& pole,
               Profile& profile) {
  for (const Surface::Step& step : surface.steps_from(vertex)) {
    const glm::dvec3 from = surface.positions[vertex.value()] - pivot;
    const glm::dvec3 to = surface.positions[step.to.value()] - pivot;
    for (const double t : {0.0, 0.25, 0.5, 0.75}) profile.add(from + t * (to - from), pole);
  }
}

std::array<float, Lids::ball_places> ball_of(const Surface& surface, const ModelledEye& eye, const glm::dvec3& pivot,
                                             const glm::dvec3& pole) {
  if (!eye.ball) return {};
  Profile profile;
  for (const SurfaceVertexId v : eye.held) add_edges(surface, v, pivot, pole, profile);
  profile.fill(eye.ball->radius);
  return profile.radii();
}

/// The outermost parts of the eye count: a cornea lies in front of an iris.
std::array<float, Lids::ball_places> ball_of(const Surface& surface, std::span<const Part> parts, PartRole role,
                                             const glm::dvec3& pivot, const glm::dvec3& pole) {
  std::array<float, Lids::ball_places> outermost{};
  for (std::uint32_t p = 0; p < parts.size(); ++p) {
    if (parts[p].role != role) continue;
    Profile profile;
    for (const SurfaceVertexId v : surface.members_of(PartId(p))) add_edges(surface, v, pivot, pole, profile);
    const auto radii = profile.radii();
    for (std::size_t k = 0; k < outermost.size(); ++k) outermost[k] = std::max(outermost[k], radii[k]);
  }
  return outermost;
}

glm::dvec3 pole_of(const Rig& rig, std::size_t eye, const glm::dvec3& pivot) {
  constexpr glm::dvec3 ahead(0.0, 0.0, 1.0);
  if (rig.irises[eye]) return rig.irises[eye]->axis;
  const FeaturePoint* const pupil = find_point(rig.points, eye == 0 ? "3.5" : "3.6");
  if (pupil == nullptr) return ahead;
  const glm::dvec3 to_pupil = glm::dvec3(pupil->position) - pivot;
  return glm::length(to_pupil) > 0.0 ? glm::normalize(to_pupil) : ahead;
}

}  // namespace

std::optional<Lids> find_lids(const Surface& surface, const EyeEdges& edges, const Rig& rig, std::size_t eye,
                              const ModelledEye* modelled) {
  const glm::dvec3 pivot(eye == 0 ? rig.left_eye_pivot : rig.right_eye_pivot);
  glm::dvec3 upper = modelled != nullptr ? modelled->upper : edges.upper.middle.position;
  glm::dvec3 lower = modelled != nullptr ? modelled->lower : edges.lower.middle.position;
  if (modelled == nullptr) {
    const double beside = opening_height(edges.upper, edges.lower) - (upper.y - lower.y);
    upper.y += 0.5 * beside;
    lower.y -= 0.5 * beside;
  }
  // Behind the axis a lid would slide the other way.
  if (upper.z <= pivot.z || lower.z <= pivot.z) return std::nullopt;
  const double slit = angle_of(upper, pivot) - angle_of(lower, pivot);
  if (slit < -greatest_overlap || slit > greatest_slit) return std::nullopt;
  Lids lids;
  lids.slit = static_cast<float>(std::max(slit, least_slit));
  const double least = least_slit * std::hypot(upper.y - pivot.y, upper.z - pivot.z);
  lids.opening = static_cast<float>(std::max(upper.y - lower.y, least));
  for (float& share : lids.gaze_share) share *= static_cast<float>(smooth_step(closed_slit, open_slit, slit));
  const glm::dvec3 pole = pole_of(rig, eye, pivot);
  lids.gaze = pole;
  lids.ball = modelled != nullptr ? ball_of(surface, *modelled, pivot, pole)
                                  : ball_of(surface, rig.parts, eyeball_role(eye), pivot, pole);
  return lids;
}

double radius_towards(const Lids& lids, const glm::dvec3& pole, const glm::dvec3& d) {
  const double cosine = std::clamp(glm::dot(d, pole) / glm::length(d), 0.0, 1.0);
  const double at = std::sqrt(1.0 - cosine) * (Lids::ball_places - 1);
  const auto k = std::min(static_cast<std::size_t>(at), Lids::ball_places - 2);
  return std::lerp(lids.ball[k], lids.ball[k + 1], at - static_cast<double>(k));
}

std::optional<Sphere> hiding_ball(const Rig& rig, std::size_t eye) {
  if (!has_part(rig.parts, eyeball_role(eye)) || !rig.lids[eye]) return std::nullopt;
  const auto& radii = rig.lids[eye]->ball;
  return Sphere{eye == 0 ? rig.left_eye_pivot : rig.right_eye_pivot, *std::min_element(radii.begin(), radii.end()),
                0.0};
}

}  // namespace semblante
