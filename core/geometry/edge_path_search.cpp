#include "core/geometry/edge_path_search.h"

#include <algorithm>
#include <cassert>
#include <limits>

namespace semblante {
namespace {
constexpr double unreachable = std::numeric_limits<double>::infinity();
/// Children of a heap node. Four halve the depth of a binary heap and sit in one cache line (4 x 16 bytes).
constexpr std::size_t arity = 4;
}  // namespace

EdgePathSearch::EdgePathSearch(const Surface& surface)
    : surface_(surface), distances_(surface.vertex_count(), unreachable) {}

void EdgePathSearch::push(Entry entry) {
  std::size_t hole = heap_.size();
  heap_.push_back(entry);
  while (hole > 0) {
    const std::size_t parent = (hole - 1) / arity;
    if (heap_[parent].distance <= entry.distance) break;
    heap_[hole] = heap_[parent];
    hole = parent;
  }
  heap_[hole] = entry;
}

EdgePathSearch::Entry EdgePathSearch::pop() {
  const Entry top = heap_.front();
  const Entry last = heap_.back();
  heap_.pop_back();
  const std::size_t size = heap_.size();
  if (size == 0) return top;
  std::size_t hole = 0;
  for (;;) {
    const std::size_t first = hole * arity + 1;
    if (first >= size) break;
    const std::size_t end = std::min(first + arity, size);
    std::size_t least = first;
    for (std::size_t child = first + 1; child < end; ++child) {
      if (heap_[child].distance < heap_[least].distance) least = child;
    }
    if (heap_[least].distance >= last.distance) break;
    heap_[hole] = heap_[least];
    hole = least;
  }
  heap_[hole] = last;
  return top;
}

std::span<const double> EdgePathSearch::from(std::span<const SurfaceVertexId> sources) {
  // A search leaves its marks on the parts of its sources only.
  for (const PartId part : touched_) {
    for (const SurfaceVertexId s : surface_.members_of(part)) distances_[s.value()] = unreachable;
  }
  touched_.clear();
  heap_.clear();
  for (const SurfaceVertexId source : sources) {
    assert(source.value() < surface_.vertex_count());
    const PartId part = surface_.part_of[source.value()];
    if (std::find(touched_.begin(), touched_.end(), part) == touched_.end()) touched_.push_back(part);
    distances_[source.value()] = 0.0;
    push({0.0, source.value()});
  }
  while (!heap_.empty()) {
    const Entry at = pop();
    if (at.distance > distances_[at.vertex]) continue;  // stale: a shorter way was found after it was pushed
    for (const Surface::Step& step : surface_.steps_from(SurfaceVertexId(at.vertex))) {
      const double distance = at.distance + step.length;
      if (distance >= distances_[step.to.value()]) continue;
      distances_[step.to.value()] = distance;
      push({distance, step.to.value()});
    }
  }
  return distances_;
}

}  // namespace semblante
