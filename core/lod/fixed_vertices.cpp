#include "core/lod/fixed_vertices.h"

#include <algorithm>
#include <array>
#include <optional>
#include <queue>
#include <span>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "core/geometry/stitch.h"
#include "core/tables/openings.h"

namespace semblante {
namespace {

/// The contours of the standard's figure as sequences of feature points.
using Contour = std::span<const std::string_view>;
constexpr std::array<std::string_view, 5> inner_upper_lip = {"2.4", "2.6", "2.2", "2.7", "2.5"};
constexpr std::array<std::string_view, 5> inner_lower_lip = {"2.4", "2.8", "2.3", "2.9", "2.5"};
constexpr std::array<std::string_view, 7> outer_upper_lip = {"8.3", "8.5", "8.10", "8.1", "8.9", "8.6", "8.4"};
constexpr std::array<std::string_view, 5> outer_lower_lip = {"8.3", "8.7", "8.2", "8.8", "8.4"};
constexpr std::array<std::string_view, 3> left_upper_lid = {"3.7", "3.1", "3.11"};
constexpr std::array<std::string_view, 3> left_lower_lid = {"3.7", "3.3", "3.11"};
constexpr std::array<std::string_view, 3> right_upper_lid = {"3.8", "3.2", "3.12"};
constexpr std::array<std::string_view, 3> right_lower_lid = {"3.8", "3.4", "3.12"};
constexpr std::array<Contour, 8> contours = {inner_upper_lip, inner_lower_lip, outer_upper_lip, outer_lower_lip,
                                             left_upper_lid,  left_lower_lid,  right_upper_lid, right_lower_lid};

/// A slit (mouth or eye) that must be able to open: the feature points that move its upper and its lower side.
struct Slit {
  std::span<const std::string_view> upper, lower;
};
using mpeg4::openings;
constexpr std::array<Slit, 3> slits = {{{openings[0].upper_flesh, openings[0].lower_flesh},
                                        {openings[1].upper, openings[1].lower},
                                        {openings[2].upper, openings[2].lower}}};

/// Minimum difference of the two sides' weights, at both ends of an edge, for the edge to separate them.
constexpr float clear_majority = 0.25F;

std::optional<SurfaceVertexId> vertex_of(const Surface& surface, const FeaturePointSet& points, std::string_view name) {
  const auto id = parse_feature_point(name);
  for (const FeaturePoint& point : points) {
    if (point.id == id && point.vertex) return surface.surface_of[point.vertex->value()];
  }
  return std::nullopt;
}

/// The vertices of the shortest path along edges, including both ends; empty if there is none. The search is bounded by
/// the length of the path, so that a contour costs the same on a head and on a whole body.
std::vector<SurfaceVertexId> shortest_way(const Surface& surface, SurfaceVertexId from, SurfaceVertexId to) {
  if (surface.part_of[from.value()] != surface.part_of[to.value()]) return {};
  struct Reached {
    double distance;
    SurfaceVertexId before;
  };
  std::unordered_map<std::uint32_t, Reached> reached = {{from.value(), {0.0, from}}};
  using Entry = std::pair<double, std::uint32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> pending;
  pending.emplace(0.0, from.value());
  while (!pending.empty()) {
    const auto [distance, at] = pending.top();
    pending.pop();
    if (distance > reached.at(at).distance) continue;
    if (at == to.value()) break;
    for (const Surface::Step& step : surface.steps_from(SurfaceVertexId(at))) {
      const double length = distance + step.length;
      const auto [entry, added] = reached.try_emplace(step.to.value(), Reached{length, SurfaceVertexId(at)});
      if (!added && length >= entry->second.distance) continue;
      entry->second = {length, SurfaceVertexId(at)};
      pending.emplace(length, step.to.value());
    }
  }
  std::vector<SurfaceVertexId> way;
  if (!reached.contains(to.value())) return way;
  for (SurfaceVertexId at = to; at != from; at = reached.at(at.value()).before) way.push_back(at);
  way.push_back(from);
  return way;
}

/// Neighbours along border edges (edges of a single triangle), for each vertex that has any.
std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> rims(const Surface& surface, const Model& model) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> sides;
  sides.reserve(model.triangles.size() * 3);
  for (const Triangle& t : model.triangles) {
    const Triangle s = {surface.surface_of[t[0]].value(), surface.surface_of[t[1]].value(),
                        surface.surface_of[t[2]].value()};
    if (!has_three_corners(s)) continue;
    for (std::size_t c = 0; c < 3; ++c) sides.push_back(std::minmax(s[c], s[(c + 1) % 3]));
  }
  std::sort(sides.begin(), sides.end());
  std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> neighbours;
  for (std::size_t first = 0; first < sides.size();) {
    std::size_t last = first + 1;
    while (last < sides.size() && sides[last] == sides[first]) ++last;
    if (last == first + 1) {
      neighbours[sides[first].first].push_back(sides[first].second);
      neighbours[sides[first].second].push_back(sides[first].first);
    }
    first = last;
  }
  return neighbours;
}

void fix_contours(const Surface& surface, const FeaturePointSet& points, std::vector<bool>& fixed) {
  for (const Contour contour : contours) {
    std::optional<SurfaceVertexId> before;
    for (const std::string_view name : contour) {
      const auto at = vertex_of(surface, points, name);
      if (!at) continue;
      if (before) {
        for (const SurfaceVertexId v : shortest_way(surface, *before, *at)) fixed[v.value()] = true;
      }
      before = at;
    }
  }
}

void fix_rims(const Surface& surface, const Model& model, const FeaturePointSet& points, std::vector<bool>& fixed) {
  const auto neighbours = rims(surface, model);
  std::vector<std::uint32_t> pending;
  for (const Contour contour : contours) {
    for (const std::string_view name : contour) {
      if (const auto at = vertex_of(surface, points, name)) pending.push_back(at->value());
    }
  }
  std::vector<bool> seen(surface.vertex_count(), false);
  while (!pending.empty()) {
    const std::uint32_t at = pending.back();
    pending.pop_back();
    const auto rim = neighbours.find(at);
    if (seen[at] || rim == neighbours.end()) continue;
    seen[at] = fixed[at] = true;
    pending.insert(pending.end(), rim->second.begin(), rim->second.end());
  }
}

void fix_slit(const Surface& surface, const WeightTable<float>& influence, const Slit& slit, std::vector<bool>& fixed) {
  std::array<float, feature_point_count> side{};  // +1 upper, -1 lower
  for (const std::string_view name : slit.upper) side[parse_feature_point(name)->value()] = 1.0F;
  for (const std::string_view name : slit.lower) side[parse_feature_point(name)->value()] = -1.0F;
  std::vector<float> majority(surface.vertex_count(), 0.0F);
  for (std::size_t s = 0; s < majority.size(); ++s) {
    const std::uint32_t v = surface.file_vertex_of[s].value();
    const auto ids = influence.points_of(v);
    const auto shares = influence.weights_of(v);
    for (std::size_t i = 0; i < ids.size(); ++i) majority[s] += side[ids[i].value()] * shares[i];
  }
  for (std::uint32_t s = 0; s < majority.size(); ++s) {
    if (majority[s] <= clear_majority) continue;
    for (const Surface::Step& step : surface.steps_from(SurfaceVertexId(s))) {
      if (majority[step.to.value()] < -clear_majority) fixed[s] = fixed[step.to.value()] = true;
    }
  }
}

}  // namespace

std::vector<bool> fixed_vertices(const Surface& surface, const Model& model, const FeaturePointSet& points,
                                 const WeightTable<float>& influence) {
  std::vector<bool> fixed(surface.vertex_count(), false);
  for (const FeaturePoint& point : points) {
    if (point.vertex) fixed[surface.surface_of[point.vertex->value()].value()] = true;
  }
  fix_contours(surface, points, fixed);
  fix_rims(surface, model, points, fixed);
  for (const Slit& slit : slits) fix_slit(surface, influence, slit, fixed);
  return fixed;
}

}  // namespace semblante
