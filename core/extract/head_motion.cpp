#include "core/extract/head_motion.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <vector>

#include <glm/geometric.hpp>

#include "core/geometry/similarity.h"

namespace semblante {
namespace {

constexpr std::size_t most_samples = 20'000;
constexpr std::size_t least_samples = 8;
constexpr int most_rounds = 50;

std::optional<HeadMotion> fit(std::span<const glm::dvec3> neutral, std::span<const glm::dvec3> moved,
                              std::span<const std::uint32_t> of) {
  std::vector<glm::dvec3> from, to;
  for (const std::uint32_t i : of) {
    from.push_back(moved[i]);
    to.push_back(neutral[i]);
  }
  // A head does not grow: uses the rotation of the similarity, which is that of the rigid fit, and ignores its scale.
  const auto similarity = fit_similarity(from, to);
  if (!similarity) return std::nullopt;
  return HeadMotion{similarity->rotation, similarity->to, similarity->from};
}

}  // namespace

double HeadMotion::degrees() const {
  const double cosine = (back[0][0] + back[1][1] + back[2][2] - 1.0) / 2.0;
  return std::acos(std::clamp(cosine, -1.0, 1.0)) * 180.0 / 3.14159265358979323846;
}

std::optional<HeadMotion> find_head_motion(std::span<const glm::vec3> neutral, std::span<const glm::vec3> moved) {
  assert(neutral.size() == moved.size());
  const std::size_t step = std::max<std::size_t>(1, (neutral.size() + most_samples - 1) / most_samples);
  std::vector<glm::dvec3> before, after;
  for (std::size_t v = 0; v < neutral.size(); v += step) {
    before.emplace_back(neutral[v]);
    after.emplace_back(moved[v]);
  }
  if (before.size() < least_samples) return std::nullopt;
  std::vector<std::uint32_t> order(before.size());
  std::iota(order.begin(), order.end(), 0U);
  const std::size_t half = before.size() / 2;
  auto motion = fit(before, after, order);
  std::vector<double> residual(before.size());
  std::vector<std::uint32_t> still;
  for (int round = 0; motion && round < most_rounds; ++round) {
    for (std::size_t i = 0; i < before.size(); ++i) {
      const glm::dvec3 off = motion->undo(after[i]) - before[i];
      residual[i] = glm::dot(off, off);
    }
    // The lower number is first on a tie, so that the result is deterministic.
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
      return residual[a] != residual[b] ? residual[a] < residual[b] : a < b;
    });
    std::vector<std::uint32_t> kept(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(half));
    std::sort(kept.begin(), kept.end());
    if (kept == still) break;
    still = std::move(kept);
    motion = fit(before, after, still);
  }
  return motion;
}

}  // namespace semblante
