#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/geometry/surface.h"
#include "core/types/model.h"

namespace semblante {

/// The distinct corners of triangles at a surface vertex: corners differ by UV, label, crease or colour. A vertex with
/// several corners is on a seam. A corner is also one vertex for the GPU.
struct Corner {
  std::uint32_t surface_vertex;
  std::uint32_t file_vertex;  ///< of several with the same look, the first
  std::uint32_t uv;           ///< into Model::uvs, or Model::no_index
  std::uint32_t normal;       ///< into Model::normals, or Model::no_index
};

struct Corners {
  std::vector<Corner> corners;                          ///< #C
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< #T by 3, into corners
};

/// Merges equal corners of `model`, independent of their file vertices and indices, because files split vertices
/// unnecessarily. Labels (one per triangle, or none) define the borders between materials.
///
/// Normals less than 10 degrees apart count as equal, because files round them, and so do colours of vertices that
/// differ little. Normals and colours are ignored without `with_normals`, and if they part most vertices (flat
/// shading).
Corners join_corners(const Model& model, const Surface& surface, std::span<const std::uint8_t> labels,
                     bool with_normals);

}  // namespace semblante
