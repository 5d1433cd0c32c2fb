#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "core/geometry/surface.h"
#include "core/lod/corners.h"
#include "core/types/model.h"

namespace semblante {

/// The normal of each corner of the full mesh and the area that it stands for (a third of its triangles').
struct CornerNormals {
  std::vector<glm::dvec3> normals;  ///< #C, unit length; of the file, or of the full surface where the file has none
  std::vector<double> areas;        ///< #C, in square units of the model
};
CornerNormals corner_normals(const Model& model, const Surface& surface, const Corners& corners);

/// Normals for a level: those of the full mesh; but where one is far from the mean over the corners that were collapsed
/// into its own, by area, that mean. A single vertex may face elsewhere than the surface around it: at the corner of a
/// mouth its normal is that of a fold of a millimetre, and would be the shading of a level's triangles of ten. Corners
/// count by how far they face along the mean, so that what is behind a rim (the inside of the mouth) does not turn the
/// rim. Where the surface is smooth the mean is no better: a vertex is rarely in the middle of what it replaces.
///
/// `kept`: #C, for each corner of the full mesh the corner of the level that it was collapsed into, or itself. Returns
/// #C normals of unit length; only those of the level's corners have a meaning.
std::vector<glm::vec3> level_normals(const CornerNormals& full, std::span<const std::uint32_t> kept);

}  // namespace semblante
