#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "core/types/model.h"

namespace semblante {

/// Stitches seams, but not contacts. A boundary edge has one triangle, by file index.
/// If boundary edges coincide (both ends at equal float32 positions, -0 equal to +0), their ends are merged.
///
/// Returns #V entries: for each file vertex the lowest one it was merged with; itself if nothing was stitched.
std::vector<std::uint32_t> stitch_seams(std::span<const glm::vec3> positions, std::span<const Triangle> triangles);

/// False for a triangle with a repeated vertex: it is degenerate, and strips use such triangles to jump between
/// unconnected places.
inline bool has_three_corners(const Triangle& t) { return t[0] != t[1] && t[1] != t[2] && t[2] != t[0]; }

}  // namespace semblante
