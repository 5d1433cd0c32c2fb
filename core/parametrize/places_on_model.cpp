#include "core/parametrize/places_on_model.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/geometry/insert_vertices.h"
#include "core/geometry/nearest_weights.h"
#include "core/geometry/stitch.h"

namespace semblante {
namespace {

// Both relative to the diagonal of the model's box.
constexpr double at_place = 1e-4;
constexpr double may_project = 0.05;

}  // namespace

PlacesOnModel::PlacesOnModel(const Model& model, const Surface& surface) : model_(model), surface_(surface) {
  if (model.positions.empty()) return;
  glm::dvec3 low(model.positions[0]);
  glm::dvec3 high = low;
  for (const glm::vec3& p : model.positions) {
    low = glm::min(low, glm::dvec3(p));
    high = glm::max(high, glm::dvec3(p));
  }
  diagonal_ = glm::distance(low, high);
}

double PlacesOnModel::distance(std::uint32_t vertex, const glm::dvec3& position) const {
  return glm::distance(at(vertex), position);
}

bool PlacesOnModel::is_used(std::uint32_t vertex) const {
  return !surface_.steps_from(surface_.surface_of[vertex]).empty();
}

glm::dvec3 PlacesOnModel::position_of(const TrianglePlace& place) const {
  const Triangle& t = model_.triangles[place.triangle];
  return place.shares.x * at(t[0]) + place.shares.y * at(t[1]) + place.shares.z * at(t[2]);
}

std::optional<std::uint32_t> PlacesOnModel::vertex_at(const glm::dvec3& position, const OwnSide* own_side) const {
  std::optional<std::uint32_t> best;
  const auto is_there = [&](std::uint32_t v) { return is_used(v) && distance(v, position) <= at_place * diagonal_; };
  const auto part_of = [&](std::uint32_t v) { return surface_.part_of[surface_.surface_of[v].value()]; };
  const auto part_size = [&](std::uint32_t v) { return surface_.members_of(part_of(v)).size(); };
  // Where rims touch, each has a vertex at the same place.
  bool on_own_side = false;
  for (std::uint32_t v = 0; v < model_.positions.size(); ++v) {
    if (!is_there(v)) continue;
    const bool own = own_side != nullptr && own_side->has(surface_.surface_of[v]);
    if (best && (own < on_own_side || (own == on_own_side && part_size(v) <= part_size(*best)))) continue;
    best = v;
    on_own_side = own;
  }
  if (!best) return best;
  // The nearest vertex of the chosen part: `at_place` may include several vertices of a fine mesh.
  const PartId part = part_of(*best);
  for (std::uint32_t v = *best + 1; v < model_.positions.size(); ++v) {
    if (!is_there(v) || part_of(v) != part || distance(v, position) >= distance(*best, position)) continue;
    if (!on_own_side || own_side->has(surface_.surface_of[v])) best = v;
  }
  return best;
}

std::optional<FeaturePoint> PlacesOnModel::nearest_place(FeaturePointId id, const glm::dvec3& position,
                                                         const OwnSide* own_side) const {
  auto nearest = nearest_on_triangles(position, own_side);
  if (!nearest && own_side != nullptr) nearest = nearest_on_triangles(position, nullptr);
  if (!nearest) return std::nullopt;
  const Triangle& t = model_.triangles[nearest->triangle];
  const auto corner = meant_corner(nearest->shares, at(t[0]), at(t[1]), at(t[2]));
  if (corner) return at_vertex(id, t[*corner]);
  nearest->shares = moved_to_edge(nearest->shares);
  return FeaturePoint{id, std::nullopt, glm::vec3(position_of(*nearest)), nearest};
}

std::optional<TrianglePlace> PlacesOnModel::nearest_on_triangles(const glm::dvec3& position,
                                                                 const OwnSide* own_side) const {
  struct Candidate {
    TrianglePlace place;
    double away;
    std::size_t part_size;
  };
  std::vector<Candidate> candidates;  // not farther than the nearest by more than at_place
  double least = may_project * diagonal_;
  for (std::uint32_t i = 0; i < model_.triangles.size(); ++i) {
    const Triangle& t = model_.triangles[i];
    const glm::dvec3 a = at(t[0]);
    const glm::dvec3 b = at(t[1]);
    const glm::dvec3 c = at(t[2]);
    const double reach = least + at_place * diagonal_;
    const glm::dvec3 beyond = glm::max(glm::min(glm::min(a, b), c) - position, position - glm::max(glm::max(a, b), c));
    if (std::max({beyond.x, beyond.y, beyond.z}) > reach || !has_three_corners(t)) continue;
    const auto is_opposite = [&](std::uint32_t v) { return own_side->is_opposite(surface_.surface_of[v]); };
    if (own_side != nullptr && std::any_of(t.begin(), t.end(), is_opposite)) continue;
    const TrianglePlace place{i, nearest_weights(position, a, b, c)};
    const double away = glm::distance(position, position_of(place));
    if (away > reach) continue;
    least = std::min(least, away);
    const PartId part = surface_.part_of[surface_.surface_of[t[0]].value()];
    candidates.push_back({place, away, surface_.members_of(part).size()});
  }
  const Candidate* best = nullptr;
  for (const Candidate& one : candidates) {
    if (one.away > least + at_place * diagonal_) continue;
    if (best == nullptr || one.part_size > best->part_size ||
        (one.part_size == best->part_size && one.away < best->away))
      best = &one;
  }
  return best == nullptr ? std::nullopt : std::optional(best->place);
}

}  // namespace semblante
