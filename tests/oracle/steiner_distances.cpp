#include "tests/oracle/steiner_distances.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

#include <glm/geometric.hpp>

namespace semblante::oracle {

std::uint32_t SteinerDistances::side_nodes(std::uint32_t low, std::uint32_t high, std::uint32_t per_edge) {
  sides_of_.resize(vertex_count_);
  for (const Side& side : sides_of_[low]) {
    if (side.high == high) return side.first_node;
  }
  const auto first = static_cast<std::uint32_t>(positions_.size());
  for (std::uint32_t k = 1; k <= per_edge; ++k) {
    const double t = static_cast<double>(k) / (per_edge + 1);
    positions_.push_back((1.0 - t) * positions_[low] + t * positions_[high]);
  }
  sides_of_[low].push_back({low, high, first});
  return first;
}

void SteinerDistances::add_triangle(const std::array<std::uint32_t, 3>& corners, std::uint32_t per_edge) {
  if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) return;
  std::vector<std::uint32_t> nodes(corners.begin(), corners.end());
  for (std::size_t c = 0; c < 3; ++c) {
    const auto [low, high] = std::minmax(corners[c], corners[(c + 1) % 3]);
    const std::uint32_t first = side_nodes(low, high, per_edge);
    for (std::uint32_t k = 0; k < per_edge; ++k) nodes.push_back(first + k);
  }
  faces_of_.resize(positions_.size());
  for (const std::uint32_t node : nodes) faces_of_[node].push_back(static_cast<std::uint32_t>(faces_.size()));
  faces_.push_back(std::move(nodes));
}

std::vector<double> SteinerDistances::from(std::uint32_t source) const {
  std::vector<double> distances(positions_.size(), std::numeric_limits<double>::infinity());
  using Entry = std::pair<double, std::uint32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> pending;
  distances[source] = 0.0;
  pending.emplace(0.0, source);
  while (!pending.empty()) {
    const auto [distance, at] = pending.top();
    pending.pop();
    if (distance > distances[at] || at >= faces_of_.size()) continue;
    for (const std::uint32_t face : faces_of_[at]) {
      for (const std::uint32_t to : faces_[face]) {
        const double next = distance + glm::distance(positions_[at], positions_[to]);
        if (!(next < distances[to])) continue;
        distances[to] = next;
        pending.emplace(next, to);
      }
    }
  }
  distances.resize(vertex_count_);
  return distances;
}

}  // namespace semblante::oracle
