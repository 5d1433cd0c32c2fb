#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/geometry/surface.h"
#include "core/types/model.h"

namespace semblante {

/// What the corners of triangles look like at a surface vertex: one entry for every different look, in which UV, label
/// or crease differ. A vertex with several is on a seam. An entry is also what a GPU draws as one vertex.
struct Corner {
  std::uint32_t surface_vertex;
  std::uint32_t file_vertex;  ///< of several with the same look, the first
  std::uint32_t uv;           ///< into Model::uvs, or Model::no_index
  std::uint32_t normal;       ///< into Model::normals, or Model::no_index
};

struct Corners {
  std::vector<Corner> corners;                          ///< #C
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< #T by 3, into corners
  bool has_normals = false;  ///< false also where the file's normals part most vertices (flat shading): not kept
};

/// Joins the corners of `model` that look the same, whatever file vertices or indices they name: files split vertices
/// that nothing parts. Labels (one a triangle, or none) say where one material ends and another begins.
///
/// Normals less than 10 degrees apart are the same look; whoever writes a file rounds them. Without `with_normals`, or
/// where the model has none, they part nothing.
Corners join_corners(const Model& model, const Surface& surface, std::span<const std::uint8_t> labels,
                     bool with_normals);

}  // namespace semblante
