#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/geometry/surface.h"
#include "core/lod/decimate.h"
#include "core/types/model.h"

namespace semblante {

/// Distances from vertices of the full surface to a level of it, in model units.
struct SurfaceError {
  double max = 0.0, mean = 0.0, rms = 0.0;
};

struct LevelError {
  SurfaceError neutral;
  std::vector<SurfaceError> poses;  ///< in the order of the poses
  /// Texture error: difference between the UV at the nearest point on the level and the vertex's UV, in UV units.
  /// Vertices on a seam have several UVs and are excluded.
  double uv_max = 0.0, uv_mean = 0.0;
  std::uint32_t flipped_triangles = 0;  ///< that face away from the full surface around them, at rest
  std::uint32_t flipped_uvs = 0;        ///< whose texture is mirrored against the triangle that they were
};

/// Measures `level` against the full `model`: from every used vertex of the model (from an even sample of 50000, if
/// there are more) to the nearest point on the level's triangles of the same part, both in the same pose.
LevelError measure_level(const Model& model, const Surface& surface, const LevelOfDetail& level,
                         std::span<const LodPose> poses);

}  // namespace semblante
