#include "core/anatomy/mirror_plane.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>

#include "core/geometry/nearest_point.h"
#include "core/geometry/similarity.h"

namespace semblante {
namespace {

/// Weight of the upright axes: that of one pair a fifth of ES0 apart.
constexpr double upright = 0.04;

MirrorPlane fit(std::span<const MirrorPair> pairs, std::span<const glm::dvec3> middle, double pair_weight,
                std::span<const MirrorPair> soft_pairs, double soft_weight) {
  glm::dvec3 center{0.0};
  double weight = 0.0;
  const auto hold = [&](const glm::dvec3& p, double w) {
    center += w * p;
    weight += w;
  };
  for (const glm::dvec3& p : middle) hold(p, pair_weight);
  for (const MirrorPair& pair : pairs) hold(0.5 * (pair.left + pair.right), pair_weight);
  for (const MirrorPair& pair : soft_pairs) hold(0.5 * (pair.left + pair.right), soft_weight);
  if (!(weight > 0.0)) return {};
  center /= weight;

  // Pairs pull the normal towards their difference, points on the plane away from their offset from the centre: the
  // normal is the principal axis of the sum.
  glm::dmat3 wish{0.0};
  const auto add_pair = [&](const MirrorPair& pair, double w) {
    const glm::dvec3 half = 0.5 * (pair.left - pair.right);
    const glm::dvec3 at = 0.5 * (pair.left + pair.right) - center;
    wish += w * glm::outerProduct(half, half);
    wish -= w * glm::outerProduct(at, at);
  };
  for (const glm::dvec3& p : middle) wish -= pair_weight * glm::outerProduct(p - center, p - center);
  for (const MirrorPair& pair : pairs) add_pair(pair, pair_weight);
  for (const MirrorPair& pair : soft_pairs) add_pair(pair, soft_weight);
  wish[0][0] += upright;

  const double lift = glm::dot(wish[0], wish[0]) + glm::dot(wish[1], wish[1]) + glm::dot(wish[2], wish[2]);
  glm::dmat4 padded{0.0};
  for (int c = 0; c < 3; ++c) padded[c] = glm::dvec4(wish[c], 0.0);
  // The unused fourth axis must not be the principal one.
  padded[3][3] = -10.0 * std::sqrt(lift);
  glm::dvec3 normal = glm::normalize(glm::dvec3(principal_axis(padded)));
  if (normal.x < 0.0) normal = -normal;
  return {normal, glm::dot(normal, center)};
}

}  // namespace

double MirrorPlane::distance(const glm::dvec3& p) const { return glm::dot(normal, p) - offset; }
glm::dvec3 MirrorPlane::image(const glm::dvec3& p) const { return p - 2.0 * distance(p) * normal; }

MirrorPlane fit_mirror_plane(std::span<const MirrorPair> pairs, std::span<const glm::dvec3> middle) {
  return fit(pairs, middle, 1.0, {}, 0.0);
}

MirrorPlane refine_mirror_plane(const MirrorPlane& start, std::span<const MirrorPair> pairs,
                                std::span<const glm::dvec3> middle, std::span<const glm::dvec3> sample,
                                std::span<const glm::dvec3> surface) {
  constexpr int rounds = 8;
  constexpr double nearest_share = 0.6;  // fraction of the best matches to use; the others are asymmetric features
  constexpr double partner_within = 0.15;
  constexpr std::size_t few = 50;
  // All surface pairs together have the weight of the marked points, which are more reliable.
  const double marked = static_cast<double>(std::max<std::size_t>(1, pairs.size() + middle.size()));
  if (surface.size() < few) return start;
  NearestPoint partners(surface);
  MirrorPlane plane = start;
  for (int round = 0; round < rounds; ++round) {
    std::vector<std::pair<double, MirrorPair>> found;
    for (const glm::dvec3& p : sample) {
      const NearestPoint::Hit hit = partners.nearest(plane.image(p));
      if (hit.distance < partner_within)
        found.push_back({hit.distance, plane.distance(p) > 0.0 ? MirrorPair{p, surface[hit.index]}
                                                               : MirrorPair{surface[hit.index], p}});
    }
    if (found.size() < few) return start;
    std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    found.resize(static_cast<std::size_t>(nearest_share * static_cast<double>(found.size())));
    std::vector<MirrorPair> soft;
    soft.reserve(found.size());
    for (const auto& [distance, pair] : found) soft.push_back(pair);
    plane = fit(pairs, middle, 1.0, soft, marked / static_cast<double>(soft.size()));
  }
  return plane;
}

}  // namespace semblante
