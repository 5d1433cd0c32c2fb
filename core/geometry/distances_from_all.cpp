#include "core/geometry/distances_from_all.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdlib>
#include <limits>
#include <new>
#include <numeric>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#if defined(__linux__)
#include <sys/mman.h>
#endif

#include "core/geometry/edge_path_search.h"

namespace semblante {
namespace {

constexpr std::size_t lane_count = DistanceGroup::lane_count;
constexpr double unreached = std::numeric_limits<double>::infinity();
/// Radius of a group's surroundings, relative to the distance of its farthest source.
constexpr double surroundings = 1.3;
/// Rounds of four sweeps over the surroundings; the sweeps over the whole part settle the remaining vertices.
constexpr int rounds = 2;
/// Effort limit per vertex: visits, plus one for every eight vertices examined. Real heads need up to seven. On
/// surfaces with winding paths (a maze, a crumpled band) each sweep settles very few vertices, and one search per
/// source is faster.
constexpr std::size_t most_effort = 64;

/// Stable bucket sort by a key with 65536 buckets; only the speed depends on the order.
std::vector<std::uint32_t> sorted_by(std::span<const double> keys) {
  std::vector<std::uint32_t> order(keys.size());
  if (keys.empty()) return order;
  const auto [least, greatest] = std::minmax_element(keys.begin(), keys.end());
  const auto buckets = std::min<std::size_t>(65536, keys.size() / 4 + 1);
  const double range = *greatest - *least;
  const double scale = range > 0.0 ? static_cast<double>(buckets - 1) / range : 0.0;
  std::vector<std::uint32_t> bucket(keys.size());
  std::vector<std::uint32_t> next(buckets + 1, 0);
  for (std::size_t i = 0; i < keys.size(); ++i) {
    bucket[i] = static_cast<std::uint32_t>((keys[i] - *least) * scale);
    ++next[bucket[i] + 1];
  }
  std::partial_sum(next.begin(), next.end(), next.begin());
  for (std::uint32_t i = 0; i < keys.size(); ++i) order[next[bucket[i]]++] = i;
  return order;
}

/// The part with vertices renumbered so that neighbours are close in memory.
struct PartGraph {
  std::vector<std::uint32_t> vertex_of;  ///< #M, member -> vertex
  std::vector<glm::dvec3> positions;     ///< #M
  std::vector<std::uint32_t> offsets;    ///< #M + 1
  std::vector<std::uint32_t> to;         ///< #A
  std::vector<double> lengths;           ///< #A
};

/// Spreads the lower ten bits of `value` to every third bit.
std::uint32_t spread_bits(std::uint32_t value) {
  value = (value | (value << 16)) & 0x030000FFU;
  value = (value | (value << 8)) & 0x0300F00FU;
  value = (value | (value << 4)) & 0x030C30C3U;
  return (value | (value << 2)) & 0x09249249U;
}

/// Members along a Z-curve through their positions.
std::vector<std::uint32_t> z_order(const Surface& graph, std::span<const SurfaceVertexId> members) {
  glm::dvec3 low(unreached);
  glm::dvec3 high(-unreached);
  for (const SurfaceVertexId m : members) {
    low = glm::min(low, graph.positions[m.value()]);
    high = glm::max(high, graph.positions[m.value()]);
  }
  const glm::dvec3 size = high - low;
  const double extent = std::max({size.x, size.y, size.z});
  const double scale = extent > 0.0 ? 1023.0 / extent : 0.0;
  std::vector<std::uint64_t> keys;  // position on the curve, then member
  keys.reserve(members.size());
  for (std::uint32_t m = 0; m < members.size(); ++m) {
    const glm::dvec3 cell = (graph.positions[members[m].value()] - low) * scale;
    const std::uint64_t place = spread_bits(static_cast<std::uint32_t>(cell.x)) |
                                spread_bits(static_cast<std::uint32_t>(cell.y)) << 1 |
                                spread_bits(static_cast<std::uint32_t>(cell.z)) << 2;
    keys.push_back(place << 32U | m);
  }
  std::sort(keys.begin(), keys.end());
  std::vector<std::uint32_t> order;
  order.reserve(keys.size());
  for (const std::uint64_t key : keys) order.push_back(static_cast<std::uint32_t>(key));
  return order;
}

PartGraph take_part(const Surface& graph, std::span<const SurfaceVertexId> members) {
  PartGraph part;
  const std::vector<std::uint32_t> order = z_order(graph, members);
  part.vertex_of.resize(order.size());
  for (std::uint32_t v = 0; v < order.size(); ++v) part.vertex_of[order[v]] = v;
  std::vector<std::uint32_t> vertex_of_surface(graph.vertex_count());
  for (std::size_t m = 0; m < members.size(); ++m) vertex_of_surface[members[m].value()] = part.vertex_of[m];
  std::size_t arcs = 0;
  for (const SurfaceVertexId m : members) arcs += graph.steps_from(m).size();
  part.to.reserve(arcs);
  part.lengths.reserve(arcs);
  part.positions.reserve(order.size());
  part.offsets.reserve(order.size() + 1);
  part.offsets.push_back(0);
  for (const std::uint32_t member : order) {
    part.positions.push_back(graph.positions[members[member].value()]);
    for (const Surface::Step& step : graph.steps_from(members[member])) {
      part.to.push_back(vertex_of_surface[step.to.value()]);
      part.lengths.push_back(step.length);
    }
    part.offsets.push_back(static_cast<std::uint32_t>(part.to.size()));
  }
  return part;
}

/// Sorts sources so that each run of `lane_count` is spatially close: recursive bisection along the longest side.
void gather_near_sources(std::span<std::uint32_t> sources, const std::vector<glm::dvec3>& at) {
  if (sources.size() <= lane_count) return;
  glm::dvec3 low(unreached);
  glm::dvec3 high(-unreached);
  for (const std::uint32_t s : sources) {
    low = glm::min(low, at[s]);
    high = glm::max(high, at[s]);
  }
  const glm::dvec3 size = high - low;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
  const std::size_t groups = (sources.size() + lane_count - 1) / lane_count;
  const std::size_t middle = groups / 2 * lane_count;
  std::nth_element(sources.begin(), sources.begin() + static_cast<std::ptrdiff_t>(middle), sources.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return at[a][axis] < at[b][axis]; });
  gather_near_sources(sources.first(middle), at);
  gather_near_sources(sources.subspan(middle), at);
}

/// Returns the source of a group with the smallest maximum distance to the others.
glm::dvec3 middle_source(std::span<const std::uint32_t> group, const std::vector<glm::dvec3>& at) {
  glm::dvec3 middle(0.0);
  double least = unreached;
  for (const std::uint32_t a : group) {
    double farthest = 0.0;
    for (const std::uint32_t b : group) farthest = std::max(farthest, glm::distance(at[a], at[b]));
    if (farthest >= least) continue;
    least = farthest;
    middle = at[a];
  }
  return middle;
}

/// Computes the distances of one group.
class GroupSearch {
 public:
  GroupSearch(const PartGraph& part, const DistanceKernel& kernel)
      : part_(part), kernel_(kernel), place_(part.positions.size()), pending_(part.positions.size() + 8) {}

  /// Returns false when one search per source would be faster; the distances are then not final.
  [[nodiscard]] bool run(std::span<const std::uint32_t> group, const std::vector<glm::dvec3>& at,
                         std::span<const std::uint32_t> vertices, double* distances) {
    const glm::dvec3 middle = middle_source(group, at);
    keys_.clear();
    for (const glm::dvec3& p : part_.positions) keys_.push_back(glm::distance(p, middle));
    double reach = 0.0;
    for (const std::uint32_t s : group) reach = std::max(reach, surroundings * glm::distance(at[s], middle));
    const auto near =
        static_cast<std::size_t>(std::count_if(keys_.begin(), keys_.end(), [&](double key) { return key <= reach; }));
    order_ = sorted_by(keys_);
    for (std::uint32_t k = 0; k < order_.size(); ++k) place_[order_[k]] = k;

    std::fill_n(distances, part_.positions.size() * lane_count, unreached);
    std::fill(pending_.begin(), pending_.end(), std::uint8_t{0});
    for (std::size_t lane = 0; lane < group.size(); ++lane) {
      const std::uint32_t source = vertices[group[lane]];
      distances[source * lane_count + lane] = 0.0;
      for (std::uint32_t k = part_.offsets[source]; k < part_.offsets[source + 1]; ++k) {
        pending_[place_[part_.to[k]]] = 1;
      }
    }
    const DistanceGroup arrays{
        part_.offsets.data(), part_.to.data(), part_.lengths.data(), order_.data(), place_.data(),
        pending_.data(),      distances};
    settle_surroundings(arrays, near);
    std::size_t effort = 0;
    for (bool forward = true; effort <= most_effort * order_.size(); forward = !forward) {
      const std::size_t visits = kernel_.sweep(arrays, order_.size(), forward);
      if (visits == 0) return true;
      effort += visits + order_.size() / 8;
    }
    return false;
  }

 private:
  void settle_surroundings(const DistanceGroup& arrays, std::size_t near) {
    const std::array<std::vector<std::uint32_t>, 2> across = diagonal_orders(near);
    for (int round = 0; round < rounds; ++round) {
      for (const bool forward : {true, false}) {
        for (const std::vector<std::uint32_t>& list : across) {
          if (kernel_.sweep_list(arrays, list.data(), list.size(), forward) == 0) return;
        }
      }
    }
  }

  /// The first `near` positions along both diagonals of the two longest sides of the box they fill.
  [[nodiscard]] std::array<std::vector<std::uint32_t>, 2> diagonal_orders(std::size_t near) const {
    glm::dvec3 low(unreached);
    glm::dvec3 high(-unreached);
    for (std::size_t k = 0; k < near; ++k) {
      low = glm::min(low, part_.positions[order_[k]]);
      high = glm::max(high, part_.positions[order_[k]]);
    }
    const glm::dvec3 size = high - low;
    std::array<int, 3> axes = {0, 1, 2};
    std::sort(axes.begin(), axes.end(), [&](int a, int b) { return size[a] > size[b]; });
    std::vector<double> sums;
    std::vector<double> differences;
    for (std::size_t k = 0; k < near; ++k) {
      const glm::dvec3& p = part_.positions[order_[k]];
      sums.push_back(p[axes[0]] + p[axes[1]]);
      differences.push_back(p[axes[0]] - p[axes[1]]);
    }
    return {sorted_by(sums), sorted_by(differences)};
  }

  const PartGraph& part_;
  const DistanceKernel& kernel_;
  std::vector<double> keys_;
  std::vector<std::uint32_t> order_, place_;
  std::vector<std::uint8_t> pending_;
};

/// Memory for `count` distances, not initialized. It is aligned to cache lines, and large tables lie in huge pages
/// where the system has them, because they are filled and read in random order.
std::unique_ptr<double[], FreeDistances> make_lanes(std::size_t count) {
  constexpr std::size_t line = 64;
  constexpr std::size_t huge_page = std::size_t{2} << 20U;
  const std::size_t bytes = std::max(count * sizeof(double), line);
  const bool is_large = bytes >= 2 * huge_page;
  const std::size_t unit = is_large ? huge_page : line;
  const std::size_t whole = (bytes + unit - 1) / unit * unit;
  std::unique_ptr<double[], FreeDistances> lanes(static_cast<double*>(std::aligned_alloc(unit, whole)));
  if (!lanes) throw std::bad_alloc();
#if defined(__linux__)
  if (is_large) madvise(lanes.get(), whole, MADV_HUGEPAGE);
#endif
  return lanes;
}

}  // namespace

void FreeDistances::operator()(double* distances) const { std::free(distances); }

DistancesFromAll distances_from_all(const Surface& graph, PartId part, std::span<const SurfaceVertexId> sources,
                                    const DistanceKernel& kernel) {
  const std::span<const SurfaceVertexId> members = graph.members_of(part);
  PartGraph own = take_part(graph, members);
  std::vector<glm::dvec3> at;
  std::vector<std::uint32_t> vertices;
  for (const SurfaceVertexId source : sources) {
    assert(graph.part_of[source.value()] == part);
    at.push_back(graph.positions[source.value()]);
    const auto member = std::lower_bound(members.begin(), members.end(), source) - members.begin();
    vertices.push_back(own.vertex_of[static_cast<std::size_t>(member)]);
  }
  std::vector<std::uint32_t> grouped(sources.size());
  std::iota(grouped.begin(), grouped.end(), 0U);
  gather_near_sources(grouped, at);

  const std::size_t group_size = members.size() * lane_count;
  const std::size_t groups = (sources.size() + lane_count - 1) / lane_count;
  DistancesFromAll result;
  result.lanes_ = make_lanes(groups * group_size);
  result.lane_of_.resize(sources.size());
  GroupSearch search(own, kernel);
  for (std::size_t g = 0; g < groups; ++g) {
    const std::size_t first = g * lane_count;
    const auto group = std::span(grouped).subspan(first, std::min(lane_count, sources.size() - first));
    for (std::size_t lane = 0; lane < group.size(); ++lane) result.lane_of_[group[lane]] = g * group_size + lane;
    double* const distances = result.lanes_.get() + g * group_size;
    if (search.run(group, at, vertices, distances)) continue;
    EdgePathSearch single(graph);
    for (std::size_t lane = 0; lane < group.size(); ++lane) {
      const std::span<const double> found = single.from(sources[group[lane]]);
      for (std::size_t m = 0; m < members.size(); ++m)
        distances[own.vertex_of[m] * lane_count + lane] = found[members[m].value()];
    }
  }
  result.vertex_of_ = std::move(own.vertex_of);
  return result;
}

}  // namespace semblante
