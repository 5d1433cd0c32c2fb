#pragma once

#include <map>
#include <string>

#include "deploy/sample_head/half_mesh.h"

namespace semblante::sample_head_detail {

/// Elevation (radians) of the hair's border seen from `hair_centre`, by azimuth 0 (front) .. pi (back).
double hairline(double azimuth);
inline const Vec3 hair_centre{0.0, 2.6, -0.7};

/// Short hair: a shell over the skull with grooves and locks over the forehead. `top` is its vertex above the crown
/// (11.5).
struct Hair {
  HalfMesh mesh;
  int top = 0;
};
Hair make_hair();

/// Across the locks in u, along them in v.
Vec2 hair_uv(const Vec3& p);

/// Middle line of the left brow at t = 0 (inner end, 4.1) .. 1 (outer end, 4.5), x and y.
Vec2 brow_line(double t);
double brow_half_height(double t);

}  // namespace semblante::sample_head_detail
