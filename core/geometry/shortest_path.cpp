#include "core/geometry/shortest_path.h"

#include <algorithm>
#include <limits>
#include <queue>
#include <tuple>
#include <unordered_map>

#include <glm/geometric.hpp>

namespace semblante {
namespace {

/// Sums in another order differ by roundings: what is longer than a path by more is longer.
constexpr double roundings = 1.0 + 1e-9;

double length_of(const Surface::Step& step, const StepCost& cost) {
  return cost ? step.length * cost(step.to) : step.length;
}

/// The length of a shortest path on one part, up to roundings; infinite if there is none. A* with the straight
/// distance.
double shortest_length(const Surface& surface, SurfaceVertexId from, SurfaceVertexId to, const StepCost& cost) {
  struct Entry {
    double at_least;  ///< of a path through the vertex
    double distance;
    std::uint32_t vertex;
    bool operator>(const Entry& other) const { return at_least > other.at_least; }
  };
  std::unordered_map<std::uint32_t, double> distances;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  const auto lower = [&](SurfaceVertexId v, double distance) {
    const auto [entry, is_new] = distances.try_emplace(v.value(), distance);
    if (!is_new && distance >= entry->second) return;
    entry->second = distance;
    const double straight = glm::distance(surface.positions[v.value()], surface.positions[to.value()]);
    queue.push({distance + straight, distance, v.value()});
  };
  lower(from, 0.0);
  while (!queue.empty()) {
    const Entry at = queue.top();
    queue.pop();
    if (at.vertex == to.value()) return at.distance;
    if (at.distance > distances.at(at.vertex)) continue;  // stale
    for (const Surface::Step& step : surface.steps_from(SurfaceVertexId(at.vertex))) {
      lower(step.to, at.distance + length_of(step, cost));
    }
  }
  return std::numeric_limits<double>::infinity();
}

}  // namespace

std::vector<SurfaceVertexId> shortest_path(const Surface& surface, SurfaceVertexId from, SurfaceVertexId to,
                                           const StepCost& cost) {
  struct Reached {
    double distance;
    SurfaceVertexId before;
    bool settled;
  };
  std::unordered_map<std::uint32_t, Reached> reached;
  using Entry = std::pair<double, std::uint32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  if (surface.part_of[from.value()] != surface.part_of[to.value()]) return {};
  // The search leaves out what lies on no path of this length: most of the circle around `from`.
  const double most = shortest_length(surface, from, to, cost) * roundings;
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
      const double longer = distance + length_of(step, cost);
      const glm::dvec3& place = surface.positions[step.to.value()];
      if (longer + glm::distance(place, surface.positions[to.value()]) > most) continue;
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
