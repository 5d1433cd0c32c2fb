#include "core/anatomy/point_symmetry.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <glm/geometric.hpp>

#include "core/tables/mpeg4.h"
#include "core/types/places.h"

namespace semblante {
namespace {

constexpr std::size_t least_pairs = 5;
constexpr double kept_share = 0.7;
/// A sculpture whose two sides were made by hand has 0.05; points in a random order have 0.5 and more.
constexpr double most_off = 0.12;

double middle_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

struct Candidate {
  MirrorPair pair;  ///< a point of the middle twice
  bool is_middle;
  double off = 0.0;
};

MirrorPlane fit(const std::vector<Candidate>& candidates, std::size_t count) {
  std::vector<MirrorPair> pairs;
  std::vector<glm::dvec3> middle;
  for (std::size_t i = 0; i < count; ++i) {
    if (candidates[i].is_middle) {
      middle.push_back(candidates[i].pair.left);
    } else {
      pairs.push_back(candidates[i].pair);
    }
  }
  return fit_mirror_plane(pairs, middle);
}

}  // namespace

std::optional<PointSymmetry> symmetry_of_points(const Places& places) {
  std::vector<Candidate> candidates;
  std::vector<double> lengths;
  for (std::size_t id = 0; id < feature_point_count; ++id) {
    const auto& info = mpeg4::feature_points[id];
    if (info.side == mpeg4::Side::right || !places[id] || !places[info.mirror]) continue;
    const bool is_middle = info.mirror == id;
    candidates.push_back({{*places[id], *places[info.mirror]}, is_middle});
    if (!is_middle) lengths.push_back(glm::distance(*places[id], *places[info.mirror]));
  }
  if (lengths.size() < least_pairs) return std::nullopt;
  const double unit = middle_of(lengths);
  if (!(unit > 0.0)) return std::nullopt;
  for (Candidate& candidate : candidates) {
    candidate.pair.left /= unit;
    candidate.pair.right /= unit;
  }

  const auto kept = static_cast<std::size_t>(kept_share * static_cast<double>(candidates.size()));
  MirrorPlane plane = fit(candidates, candidates.size());
  constexpr int rounds = 10;
  for (int round = 0; round < rounds; ++round) {
    for (Candidate& candidate : candidates) {
      candidate.off = candidate.is_middle ? std::abs(plane.distance(candidate.pair.left))
                                          : glm::distance(plane.image(candidate.pair.right), candidate.pair.left);
    }
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate& a, const Candidate& b) { return a.off < b.off; });
    plane = fit(candidates, kept);
  }
  const double off = candidates[kept - 1].off;
  if (off > most_off) return std::nullopt;
  plane.offset *= unit;
  return PointSymmetry{plane, off};
}

}  // namespace semblante
