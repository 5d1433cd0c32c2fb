#include "core/parametrize/place_feature_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <glm/geometric.hpp>

#include "core/anatomy/part_roles.h"
#include "core/anatomy/point_lookup.h"
#include "core/anatomy/rim_sides.h"
#include "core/parametrize/places_on_model.h"

namespace semblante {
namespace {

/// A vertex this far from the position given with it contradicts it; of the diagonal of the model's box.
constexpr double disagrees = 1e-3;

std::string pointer_to(FeaturePointId id) { return "/points/" + to_string(id); }

std::string join(const std::vector<FeaturePointId>& ids) {
  std::string text;
  for (const FeaturePointId id : ids) text += (text.empty() ? "" : ", ") + to_string(id);
  return text;
}

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

/// Which points have a vertex and a position that disagree.
struct Disagreement {
  std::vector<FeaturePointId> points;
  bool was_renumbered = false;  ///< only renumbered vertices explain it
};

Disagreement find_disagreement(const PlacesOnModel& places, std::span<const MarkedPoint> marked) {
  Disagreement found;
  bool every_one_found = true;
  for (const MarkedPoint& point : marked) {
    if (!point.vertex || !point.position) continue;
    if (places.distance(*point.vertex, *point.position) <= disagrees * places.diagonal()) continue;
    found.points.push_back(point.id);
    every_one_found = every_one_found && places.vertex_at(*point.position).has_value();
  }
  found.was_renumbered = !found.points.empty() && every_one_found;
  return found;
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

/// Places marked points one after the other.
class Placing {
 public:
  /// `positions_win`: over vertices, of points that have both.
  Placing(const Model& model, const Surface& surface, const PlacesOnModel& places, bool positions_win)
      : model_(model), surface_(surface), places_(places), positions_win_(positions_win) {}

  /// Points of lips and lids given by position are placed last: the other points determine their sides.
  std::optional<Error> place_all(std::span<const MarkedPoint> marked) {
    for (const MarkedPoint& point : marked) {
      if (needs_side(point)) continue;
      if (std::optional<Error> fault = place(point, nullptr)) return fault;
    }
    const std::vector<SurfacePoint> anchors = surface_points(surface_, at_corners(model_, points_));
    for (const mpeg4::Opening& opening : mpeg4::openings) {
      std::optional<RimSides> sides;
      for (const MarkedPoint& point : marked) {
        const RimOfPoint rim = rim_of_point(point.id);
        if (rim.opening != &opening || !needs_side(point)) continue;
        if (!sides) sides.emplace(surface_, opening, anchors);
        const OwnSide own_side{*sides, rim.is_upper};
        if (std::optional<Error> fault = place(point, &own_side)) return fault;
      }
    }
    return std::nullopt;
  }

  /// Sorted by id.
  [[nodiscard]] FeaturePointSet points() && {
    std::sort(points_.begin(), points_.end(), [](const FeaturePoint& a, const FeaturePoint& b) { return a.id < b.id; });
    return std::move(points_);
  }
  /// The points whose position is not on the surface; sorted.
  [[nodiscard]] std::vector<FeaturePointId> projected() const {
    std::vector<FeaturePointId> ids = projected_;
    std::sort(ids.begin(), ids.end());
    return ids;
  }

 private:
  [[nodiscard]] bool is_by_position(const MarkedPoint& point) const {
    return !point.vertex || (positions_win_ && point.position);
  }
  [[nodiscard]] bool needs_side(const MarkedPoint& point) const {
    return is_by_position(point) && rim_of_point(point.id).opening != nullptr;
  }

  std::optional<Error> place(const MarkedPoint& point, const OwnSide* own_side) {
    if (!is_by_position(point)) {
      points_.push_back(places_.at_vertex(point.id, *point.vertex));
      return std::nullopt;
    }
    const glm::dvec3& position = *point.position;
    const bool is_bare = !point.vertex && is_pupil(point.id);
    const auto vertex = is_bare ? std::nullopt : places_.vertex_at(position, own_side);
    if (vertex) {
      points_.push_back(places_.at_vertex(point.id, *vertex));
    } else if (point.vertex) {
      points_.push_back(places_.at_vertex(point.id, *point.vertex));  // its vertex agrees with its position
    } else if (is_bare || may_be_bare(point.id)) {
      points_.push_back({point.id, std::nullopt, glm::vec3(position)});
    } else {
      return place_nearest(point.id, position, own_side);
    }
    return std::nullopt;
  }

  std::optional<Error> place_nearest(FeaturePointId id, const glm::dvec3& position, const OwnSide* own_side) {
    const auto nearest = places_.nearest_place(id, position, own_side);
    if (!nearest) {
      return Error{ErrorCode::invalid_argument, pointer_to(id) + "/position",
                   "the position of point " + to_string(id) + " is not near the surface"};
    }
    const double away = glm::distance(glm::dvec3(nearest->position), position);
    if (away > disagrees * places_.diagonal()) projected_.push_back(id);
    points_.push_back(*nearest);
    return std::nullopt;
  }

  const Model& model_;
  const Surface& surface_;
  const PlacesOnModel& places_;
  bool positions_win_;
  FeaturePointSet points_;
  std::vector<FeaturePointId> projected_;
};

}  // namespace

Result<FeaturePointSet> place_feature_points(const Model& model, const Surface& surface,
                                             std::span<const MarkedPoint> marked, std::vector<std::string>* warnings,
                                             std::span<const std::optional<PartRole>> roles_by_user) {
  if (std::optional<Error> fault = find_fault(model, marked)) return std::move(*fault);
  const auto warn = [&](std::string text) {
    if (warnings != nullptr) warnings->push_back(std::move(text));
  };

  const PlacesOnModel places(model, surface);
  const Disagreement disagreement = find_disagreement(places, marked);
  if (disagreement.was_renumbered) {
    warn("the vertex numbers of " + join(disagreement.points) +
         " belong to another numbering of this model; the points were placed by their positions");
  } else if (!disagreement.points.empty()) {
    warn("vertex and position of " + join(disagreement.points) + " disagree; the vertex was taken");
  }

  Placing placing(model, surface, places, disagreement.was_renumbered);
  if (std::optional<Error> fault = placing.place_all(marked)) return std::move(*fault);
  if (const auto projected = placing.projected(); !projected.empty())
    warn("the position of " + join(projected) + " is not on the surface; the nearest place on it was taken");
  FeaturePointSet points = std::move(placing).points();
  if (std::optional<Error> fault = find_impossible_part(model, surface, points, roles_by_user))
    return std::move(*fault);
  return points;
}

}  // namespace semblante
