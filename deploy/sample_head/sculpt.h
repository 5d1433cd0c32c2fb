#pragma once

#include "deploy/sample_head/half_mesh.h"

namespace semblante::sample_head_detail {

/// The shape of the head without ears, lips and lid edges, as a signed distance in cm (negative inside): smooth unions
/// of ellipsoids and capsules, placed by general human proportions. Symmetric in x.
double head_distance(const Vec3& p);

/// Unit gradient of head_distance.
Vec3 head_normal(const Vec3& p);

/// The nearest surface point, approximately: a few Newton steps along the gradient.
Vec3 project_to_head(const Vec3& p);

/// z of the foremost surface point at (x, y).
double front_z(double x, double y);

/// The surface point in direction `direction` from `origin` inside the head.
Vec3 cast_from_inside(const Vec3& origin, const Vec3& direction);

/// The skull without face and neck, as the base of the hair.
double skull_distance(const Vec3& p);

/// Left eyeball.
inline constexpr double eye_radius = 1.42;
inline const Vec3 eye_centre{3.2, 0.0, 6.62};
inline constexpr double iris_radius = 0.655;

}  // namespace semblante::sample_head_detail
