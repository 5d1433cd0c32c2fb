#include "core/geometry/unfolded_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

namespace semblante {
namespace {

/// A triangle seen across one of its edges.
struct Wing {
  std::uint32_t low, high;  ///< the edge's ends, low < high
  std::uint32_t apex;

  bool operator==(const Wing&) const = default;
};

struct Link {
  std::uint32_t from, to;
  double length;
};

/// Sorts by `vertex_of`, a number below `vertices`, and then by `before`: few items are of one vertex.
template <class Item, class VertexOf, class Before>
void sort_by_vertex(std::vector<Item>& items, std::size_t vertices, VertexOf vertex_of, Before before) {
  std::vector<std::size_t> ends(vertices + 1, 0);  // at first where the items of each vertex begin
  for (const Item& item : items) ++ends[vertex_of(item) + 1];
  std::partial_sum(ends.begin(), ends.end(), ends.begin());
  std::vector<Item> sorted(items.size());
  for (const Item& item : items) sorted[ends[vertex_of(item)]++] = item;
  auto first = sorted.begin();
  for (std::size_t v = 0; v < vertices; ++v) {
    const auto end = sorted.begin() + static_cast<std::ptrdiff_t>(ends[v]);
    std::sort(first, end, before);
    first = end;
  }
  items = std::move(sorted);
}

std::vector<Wing> wings_of(const Surface& surface, std::span<const Triangle> triangles) {
  std::vector<Wing> wings;
  wings.reserve(triangles.size() * 3);
  for (const Triangle& t : triangles) {
    std::array<std::uint32_t, 3> s{};
    for (std::size_t c = 0; c < 3; ++c) s[c] = surface.surface_of[t[c]].value();
    if (s[0] == s[1] || s[1] == s[2] || s[2] == s[0]) continue;
    for (std::size_t c = 0; c < 3; ++c) {
      const auto [low, high] = std::minmax(s[c], s[(c + 1) % 3]);
      wings.push_back({low, high, s[(c + 2) % 3]});
    }
  }
  sort_by_vertex(
      wings, surface.vertex_count(), [](const Wing& w) { return w.low; },
      [](const Wing& a, const Wing& b) { return std::tie(a.high, a.apex) < std::tie(b.high, b.apex); });
  wings.erase(std::unique(wings.begin(), wings.end()), wings.end());  // duplicate triangles count once
  return wings;
}

/// Length of the diagonal from `first`'s apex to `second`'s after unfolding over the common edge; 0 if the diagonal
/// leaves the two triangles.
double diagonal(const Surface& surface, const Wing& first, const Wing& second) {
  const glm::dvec3& origin = surface.positions[first.low];
  const glm::dvec3 edge = surface.positions[first.high] - origin;
  const double length = glm::length(edge);
  if (!(length > 0.0)) return 0.0;
  const auto laid_flat = [&](std::uint32_t apex) {
    const glm::dvec3 to = surface.positions[apex] - origin;
    return glm::dvec2(glm::dot(to, edge) / length, glm::length(glm::cross(edge, to)) / length);
  };
  const glm::dvec2 a = laid_flat(first.apex);
  const glm::dvec2 b = laid_flat(second.apex);
  const double height = a.y + b.y;
  if (!(height > 0.0)) return 0.0;
  const double crossing = a.x + (b.x - a.x) * (a.y / height);
  if (!(crossing > 0.0 && crossing < length)) return 0.0;
  return std::hypot(b.x - a.x, height);
}

}  // namespace

Surface with_unfolded_diagonals(const Surface& surface, std::span<const Triangle> triangles) {
  std::vector<Link> links;
  links.reserve(surface.steps.size() * 2);
  for (std::uint32_t s = 0; s < surface.vertex_count(); ++s) {
    for (const Surface::Step& step : surface.steps_from(SurfaceVertexId(s))) {
      links.push_back({s, step.to.value(), step.length});
    }
  }
  const std::vector<Wing> wings = wings_of(surface, triangles);
  for (std::size_t first = 0; first < wings.size(); ++first) {
    for (std::size_t second = first + 1; second < wings.size(); ++second) {
      if (wings[second].low != wings[first].low || wings[second].high != wings[first].high) break;
      const double length = diagonal(surface, wings[first], wings[second]);
      if (!(length > 0.0)) continue;
      links.push_back({wings[first].apex, wings[second].apex, length});
      links.push_back({wings[second].apex, wings[first].apex, length});
    }
  }
  sort_by_vertex(
      links, surface.vertex_count(), [](const Link& l) { return l.from; },
      [](const Link& a, const Link& b) { return std::tie(a.to, a.length) < std::tie(b.to, b.length); });
  // Of several links between two vertices the shortest, which is sorted first.
  const auto same_ends = [](const Link& a, const Link& b) { return a.from == b.from && a.to == b.to; };
  links.erase(std::unique(links.begin(), links.end(), same_ends), links.end());

  Surface unfolded = surface;
  unfolded.steps.clear();
  unfolded.steps.reserve(links.size());
  unfolded.step_offsets.assign(surface.vertex_count() + 1, 0);
  for (const Link& link : links) {
    unfolded.steps.push_back({link.length, SurfaceVertexId(link.to)});
    ++unfolded.step_offsets[link.from + 1];
  }
  for (std::size_t s = 0; s < surface.vertex_count(); ++s) unfolded.step_offsets[s + 1] += unfolded.step_offsets[s];
  return unfolded;
}

}  // namespace semblante
