#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "core/types/model.h"

namespace semblante {

/// Stitches seams, leaves contacts apart. A boundary edge has one triangle, by file index.
/// Where boundary edges coincide, both ends at equal positions (as float32, -0 equal to +0), their ends become one.
///
/// Returns #V entries: the lowest file vertex that each file vertex is one with; itself where nothing was stitched.
std::vector<std::uint32_t> stitch_seams(std::span<const glm::vec3> positions, std::span<const Triangle> triangles);

/// False for a triangle that names a vertex twice: it has no sides, and strips use such triangles to jump between
/// places that no surface joins.
inline bool has_three_corners(const Triangle& t) { return t[0] != t[1] && t[1] != t[2] && t[2] != t[0]; }

}  // namespace semblante
