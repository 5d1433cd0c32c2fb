#include "core/parametrize/place_feature_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/anatomy/part_roles.h"
#include "core/anatomy/point_lookup.h"
#include "core/anatomy/rim_sides.h"
#include "core/geometry/insert_vertices.h"
#include "core/geometry/nearest_weights.h"
#include "core/geometry/stitch.h"

namespace semblante {
namespace {

// All relative to the diagonal of the model's box.
constexpr double disagrees = 1e-3;  ///< a vertex this far from the position given with it contradicts it
constexpr double at_place = 1e-4;   ///< room for positions printed with few digits
constexpr double may_project = 0.05;

std::string pointer_to(FeaturePointId id) { return "/points/" + to_string(id); }

std::string join(const std::vector<FeaturePointId>& ids) {
  std::string text;
  for (const FeaturePointId id : ids) text += (text.empty() ? "" : ", ") + to_string(id);
  return text;
}

/// The side of an opening that a point of a lip or lid belongs to; only for vertices whose side is certain.
struct OwnSide {
  const RimSides& sides;
  bool is_upper;

  [[nodiscard]] bool has(SurfaceVertexId vertex) const { return sides.side(vertex, is_upper) >= RimSides::clear; }
  [[nodiscard]] bool is_opposite(SurfaceVertexId vertex) const {
    return sides.side(vertex, is_upper) <= -RimSides::clear;
  }
};

class Placement {
 public:
  Placement(const Model& model, const Surface& surface) : model_(model), surface_(surface) {
    if (model.positions.empty()) return;
    glm::dvec3 low(model.positions[0]);
    glm::dvec3 high = low;
    for (const glm::vec3& p : model.positions) {
      low = glm::min(low, glm::dvec3(p));
      high = glm::max(high, glm::dvec3(p));
    }
    diagonal_ = glm::distance(low, high);
  }

  [[nodiscard]] double diagonal() const { return diagonal_; }

  [[nodiscard]] double distance(std::uint32_t vertex, const glm::dvec3& position) const {
    return glm::distance(glm::dvec3(model_.positions[vertex]), position);
  }

  /// The file vertex at `position`, see place_feature_points.
  [[nodiscard]] std::optional<std::uint32_t> vertex_at(const glm::dvec3& position,
                                                       const OwnSide* own_side = nullptr) const {
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

  /// The point at the place of the surface nearest to `position`: at a vertex if one is meant, else between vertices.
  /// Of places equally near, that of the part with the most vertices. With a side, not on a triangle that is certainly
  /// on the other side. Empty: no place within `may_project`.
  [[nodiscard]] std::optional<FeaturePoint> nearest_place(FeaturePointId id, const glm::dvec3& position,
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

  [[nodiscard]] FeaturePoint at_vertex(FeaturePointId id, std::uint32_t vertex) const {
    return {id, VertexId(vertex), model_.positions[vertex]};
  }

 private:
  /// A point found by position must not get a vertex without triangles.
  [[nodiscard]] bool is_used(std::uint32_t vertex) const {
    return !surface_.steps_from(surface_.surface_of[vertex]).empty();
  }

  [[nodiscard]] glm::dvec3 at(std::uint32_t vertex) const { return glm::dvec3(model_.positions[vertex]); }

  [[nodiscard]] glm::dvec3 position_of(const TrianglePlace& place) const {
    const Triangle& t = model_.triangles[place.triangle];
    return place.shares.x * at(t[0]) + place.shares.y * at(t[1]) + place.shares.z * at(t[2]);
  }

  [[nodiscard]] std::optional<TrianglePlace> nearest_on_triangles(const glm::dvec3& position,
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
      const glm::dvec3 beyond =
          glm::max(glm::min(glm::min(a, b), c) - position, position - glm::max(glm::max(a, b), c));
      if (std::max({beyond.x, beyond.y, beyond.z}) > reach || !has_three_corners(t)) continue;
      if (own_side != nullptr && std::any_of(t.begin(), t.end(), [&](std::uint32_t v) {
            return own_side->is_opposite(surface_.surface_of[v]);
          }))
        continue;
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

  const Model& model_;
  const Surface& surface_;
  double diagonal_ = 0.0;
};

bool may_be_bare(FeaturePointId id) { return to_string(id) == "7.1"; }

std::optional<Error> find_fault(const Model& model, std::span<const MarkedPoint> marked) {
  std::array<bool, feature_point_count> seen{};
  for (const MarkedPoint& point : marked) {
    const std::string where = pointer_to(point.id);
    if (std::exchange(seen[point.id.value()], true)) {
      return Error{ErrorCode::invalid_argument, where, "point " + to_string(point.id) + " is given twice"};
    }
    if (!point.vertex && !point.position) {
      return Error{ErrorCode::missing, where, "point " + to_string(point.id) + " has neither a vertex nor a position"};
    }
    if (point.vertex && *point.vertex >= model.positions.size()) {
      return Error{ErrorCode::out_of_range, where + "/vertex",
                   "point " + to_string(point.id) + " is at vertex " + std::to_string(*point.vertex) +
                       ", but the model has " + std::to_string(model.positions.size()) + " vertices"};
    }
    if (point.position) {
      const glm::dvec3& p = *point.position;
      if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
        return Error{ErrorCode::not_finite, where + "/position",
                     "the position of point " + to_string(point.id) + " is not finite"};
      }
    }
  }
  return std::nullopt;
}

/// True when vertices and positions contradict each other in a way that only renumbered vertices explain.
bool was_renumbered(const Placement& placement, std::span<const MarkedPoint> marked,
                    std::vector<FeaturePointId>& disagreeing) {
  bool every_one_found = true;
  for (const MarkedPoint& point : marked) {
    if (!point.vertex || !point.position) continue;
    if (placement.distance(*point.vertex, *point.position) <= disagrees * placement.diagonal()) continue;
    disagreeing.push_back(point.id);
    every_one_found = every_one_found && placement.vertex_at(*point.position).has_value();
  }
  return !disagreeing.empty() && every_one_found;
}

/// Points between vertices at the corner with the greatest share: near enough to tell part and side.
FeaturePointSet at_corners(const Model& model, FeaturePointSet points) {
  for (FeaturePoint& point : points) {
    if (!point.between) continue;
    const glm::dvec3& shares = point.between->shares;
    const std::size_t most = shares.x >= shares.y && shares.x >= shares.z ? 0 : shares.y >= shares.z ? 1 : 2;
    point.vertex = VertexId(model.triangles[point.between->triangle][most]);
  }
  return points;
}

std::optional<Error> find_impossible_part(const Model& model, const Surface& surface, const FeaturePointSet& points,
                                          std::span<const std::optional<PartRole>> roles_by_user) {
  const std::vector<SurfacePoint> on_surface = surface_points(surface, at_corners(model, points));
  std::vector<std::optional<PartRole>> roles = roles_clear_from_points(surface, on_surface);
  for (std::size_t p = 0; p < std::min(roles.size(), roles_by_user.size()); ++p) {
    if (roles_by_user[p]) roles[p] = roles_by_user[p];
  }
  for (const SurfacePoint& point : on_surface) {
    if (!is_skin_point(point.id)) continue;
    const std::optional<PartRole> role = roles[surface.part_of[point.vertex.value()].value()];
    if (!role || *role == PartRole::skin || *role == PartRole::attached || *role == PartRole::rest ||
        *role == PartRole::body) {
      continue;
    }
    std::string what(part_role_names[static_cast<std::size_t>(*role)]);
    std::replace(what.begin(), what.end(), '_', ' ');
    return Error{ErrorCode::invalid_argument, pointer_to(point.id),
                 "point " + to_string(point.id) + " belongs on the skin, but it is on a part that is " +
                     (*role == PartRole::upper_teeth || *role == PartRole::lower_teeth ? "" : "a ") + what};
  }
  return std::nullopt;
}

}  // namespace

Result<FeaturePointSet> place_feature_points(const Model& model, const Surface& surface,
                                             std::span<const MarkedPoint> marked, std::vector<std::string>* warnings,
                                             std::span<const std::optional<PartRole>> roles_by_user) {
  if (std::optional<Error> fault = find_fault(model, marked)) return std::move(*fault);
  const auto warn = [&](std::string text) {
    if (warnings != nullptr) warnings->push_back(std::move(text));
  };

  const Placement placement(model, surface);
  std::vector<FeaturePointId> disagreeing;
  const bool positions_win = was_renumbered(placement, marked, disagreeing);
  if (positions_win) {
    warn("the vertex numbers of " + join(disagreeing) +
         " belong to another numbering of this model; the points were placed by their positions");
  } else if (!disagreeing.empty()) {
    warn("vertex and position of " + join(disagreeing) + " disagree; the vertex was taken");
  }

  FeaturePointSet points;
  std::vector<FeaturePointId> projected;
  const auto place = [&](const MarkedPoint& point, const OwnSide* own_side) -> std::optional<Error> {
    if (point.vertex && !(positions_win && point.position)) {
      points.push_back(placement.at_vertex(point.id, *point.vertex));
      return std::nullopt;
    }
    const glm::dvec3& position = *point.position;
    const bool is_bare = !point.vertex && is_pupil(point.id);
    const auto vertex = is_bare ? std::nullopt : placement.vertex_at(position, own_side);
    if (vertex) {
      points.push_back(placement.at_vertex(point.id, *vertex));
    } else if (point.vertex) {
      points.push_back(placement.at_vertex(point.id, *point.vertex));  // its vertex agrees with its position
    } else if (is_bare || may_be_bare(point.id)) {
      points.push_back({point.id, std::nullopt, glm::vec3(position)});
    } else {
      auto nearest = placement.nearest_place(point.id, position, own_side);
      if (!nearest) {
        return Error{ErrorCode::invalid_argument, pointer_to(point.id) + "/position",
                     "the position of point " + to_string(point.id) + " is not near the surface"};
      }
      const double away = glm::distance(glm::dvec3(nearest->position), position);
      if (away > disagrees * placement.diagonal()) projected.push_back(point.id);
      points.push_back(*nearest);
    }
    return std::nullopt;
  };

  // Points of lips and lids given by position are placed last: the other points determine their sides.
  const auto needs_side = [&](const MarkedPoint& point) {
    return (!point.vertex || (positions_win && point.position)) && rim_of_point(point.id).opening != nullptr;
  };
  for (const MarkedPoint& point : marked) {
    if (needs_side(point)) continue;
    if (std::optional<Error> fault = place(point, nullptr)) return std::move(*fault);
  }
  const std::vector<SurfacePoint> anchors = surface_points(surface, at_corners(model, points));
  for (const mpeg4::Opening& opening : mpeg4::openings) {
    std::optional<RimSides> sides;
    for (const MarkedPoint& point : marked) {
      const RimOfPoint rim = rim_of_point(point.id);
      if (rim.opening != &opening || !needs_side(point)) continue;
      if (!sides) sides.emplace(surface, opening, anchors);
      const OwnSide own_side{*sides, rim.is_upper};
      if (std::optional<Error> fault = place(point, &own_side)) return std::move(*fault);
    }
  }
  std::sort(projected.begin(), projected.end());
  if (!projected.empty())
    warn("the position of " + join(projected) + " is not on the surface; the nearest place on it was taken");

  std::sort(points.begin(), points.end(), [](const FeaturePoint& a, const FeaturePoint& b) { return a.id < b.id; });
  if (std::optional<Error> fault = find_impossible_part(model, surface, points, roles_by_user))
    return std::move(*fault);
  return points;
}

}  // namespace semblante
