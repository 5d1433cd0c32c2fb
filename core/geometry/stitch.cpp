#include "core/geometry/stitch.h"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>

#include "core/types/place.h"

namespace semblante {
namespace {

/// An edge of one triangle, with the opposite corner. Two triangles with the same three vertices give equal records, so
/// a duplicate triangle does not turn a seam into an inner edge.
struct Side {
  std::uint32_t low, high, across;
  [[nodiscard]] auto key() const { return std::tie(low, high, across); }
  friend bool operator<(const Side& a, const Side& b) { return a.key() < b.key(); }
  friend bool operator==(const Side& a, const Side& b) { return a.key() == b.key(); }
};

/// Disjoint sets of file vertices that form one surface vertex; the lowest member represents each set.
class VertexSets {
 public:
  explicit VertexSets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0U); }

  std::uint32_t find(std::uint32_t v) {
    while (parent_[v] != v) {
      parent_[v] = parent_[parent_[v]];
      v = parent_[v];
    }
    return v;
  }
  void unite(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    if (a != b) parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

std::vector<std::pair<std::uint32_t, std::uint32_t>> boundary_edges(std::span<const Triangle> triangles) {
  std::vector<Side> sides;
  sides.reserve(triangles.size() * 3);
  for (const Triangle& t : triangles) {
    if (!has_three_corners(t)) continue;
    for (std::size_t c = 0; c < 3; ++c) {
      const auto [low, high] = std::minmax(t[c], t[(c + 1) % 3]);
      sides.push_back({low, high, t[(c + 2) % 3]});
    }
  }
  std::sort(sides.begin(), sides.end());
  sides.erase(std::unique(sides.begin(), sides.end()), sides.end());

  std::vector<std::pair<std::uint32_t, std::uint32_t>> boundary;
  for (std::size_t first = 0; first < sides.size();) {
    std::size_t last = first + 1;
    while (last < sides.size() && sides[last].low == sides[first].low && sides[last].high == sides[first].high) ++last;
    if (last == first + 1) boundary.emplace_back(sides[first].low, sides[first].high);
    first = last;
  }
  return boundary;
}

}  // namespace

std::vector<std::uint32_t> stitch_seams(std::span<const glm::vec3> positions, std::span<const Triangle> triangles) {
  const auto boundary = boundary_edges(triangles);

  // Number the positions of boundary edge ends, so that coincident edges have equal pairs of numbers.
  std::vector<std::pair<PlaceKey, std::uint32_t>> ends;
  ends.reserve(boundary.size() * 2);
  for (const auto& [a, b] : boundary) {
    ends.emplace_back(place_key(positions[a]), a);
    ends.emplace_back(place_key(positions[b]), b);
  }
  std::sort(ends.begin(), ends.end());
  std::vector<std::uint32_t> place_of(positions.size(), 0);
  std::uint32_t place = 0;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    if (i > 0 && ends[i].first != ends[i - 1].first) ++place;
    place_of[ends[i].second] = place;
  }

  // An edge by the numbers of its end positions, lower number first.
  struct PlacedEdge {
    std::uint32_t low_place, high_place, low_end, high_end;
  };
  std::vector<PlacedEdge> edges;
  edges.reserve(boundary.size());
  for (const auto& [a, b] : boundary) {
    const bool in_order = place_of[a] <= place_of[b];
    const std::uint32_t low = in_order ? a : b;
    const std::uint32_t high = in_order ? b : a;
    edges.push_back({place_of[low], place_of[high], low, high});
  }
  const auto places = [](const PlacedEdge& e) { return std::pair(e.low_place, e.high_place); };
  std::sort(edges.begin(), edges.end(),
            [&](const PlacedEdge& a, const PlacedEdge& b) { return places(a) < places(b); });

  VertexSets sets(positions.size());
  for (std::size_t i = 1; i < edges.size(); ++i) {
    const PlacedEdge& a = edges[i - 1];
    const PlacedEdge& b = edges[i];
    if (places(a) != places(b)) continue;
    sets.unite(a.low_end, b.low_end);
    sets.unite(a.high_end, b.high_end);
    // Zero-length edges have all four ends at one position; the result must not depend on the order in the file.
    if (a.low_place == a.high_place) sets.unite(a.low_end, a.high_end);
  }

  std::vector<std::uint32_t> lowest(positions.size());
  for (std::uint32_t v = 0; v < lowest.size(); ++v) lowest[v] = sets.find(v);
  return lowest;
}

}  // namespace semblante
