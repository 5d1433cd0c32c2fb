#pragma once

#include <cstdint>
#include <span>

#include <glm/vec3.hpp>

#include "core/types/feature_point_id.h"
#include "core/types/places.h"

namespace semblante {

/// The axes of an upright face: x to its left, y up, z out of it.
enum class FaceAxis : std::uint8_t { left, up, front };

/// `more` is farther along the axis than `less` on every face, by the definitions of the points in
/// core/tables/data/feature-points.json. Points that may be level are not compared.
struct PointOrder {
  FaceAxis axis;
  FeaturePointId more, less;
};

/// All known orders.
std::span<const PointOrder> point_orders();

/// In ES0, two millimetres on a human face: smaller differences are within the precision of marking, and touching lips
/// are closer.
inline constexpr double point_order_tolerance = 0.03;

/// The box in which a point keeps its order with others, each side infinite without a point there.
struct OrderBounds {
  glm::dvec3 least, most;

  [[nodiscard]] bool contains(const glm::dvec3& place) const;
};

/// `places` by FeaturePointId, in an upright frame with ES0 as unit. The box includes the tolerance.
OrderBounds order_bounds(FeaturePointId id, const Places& places);

}  // namespace semblante
