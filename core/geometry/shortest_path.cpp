#include "core/geometry/shortest_path.h"

#include <algorithm>
#include <queue>
#include <tuple>
#include <unordered_map>

namespace semblante {

std::vector<SurfaceVertexId> shortest_path(const Surface& surface, SurfaceVertexId from, SurfaceVertexId to) {
  struct Reached {
    double distance;
    SurfaceVertexId before;
    bool settled;
  };
  std::unordered_map<std::uint32_t, Reached> reached;
  using Entry = std::pair<double, std::uint32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  if (surface.part_of[from.value()] != surface.part_of[to.value()]) return {};
  reached.emplace(from.value(), Reached{0.0, from, false});
  queue.emplace(0.0, from.value());
  while (!queue.empty()) {
    const auto [distance, at] = queue.top();
    queue.pop();
    Reached& here = reached.at(at);
    if (here.settled) continue;
    here.settled = true;
    if (at == to.value()) break;
    for (const Surface::Step& step : surface.steps_from(SurfaceVertexId(at))) {
      const double longer = distance + step.length;
      const auto [entry, is_new] = reached.try_emplace(step.to.value(), Reached{longer, SurfaceVertexId(at), false});
      if (!is_new) {
        // Of equally long paths the one with the lower vertex, independent of the order of edges.
        if (std::pair(longer, at) >= std::pair(entry->second.distance, entry->second.before.value())) continue;
        if (entry->second.settled) continue;
        entry->second = {longer, SurfaceVertexId(at), false};
      }
      queue.emplace(longer, step.to.value());
    }
  }
  std::vector<SurfaceVertexId> path;
  const auto end = reached.find(to.value());
  if (end == reached.end() || !end->second.settled) return {};
  for (SurfaceVertexId at = to; at != from; at = reached.at(at.value()).before) path.push_back(at);
  path.push_back(from);
  std::reverse(path.begin(), path.end());
  return path;
}

}  // namespace semblante
