#pragma once

#include <cstdint>
#include <span>

#include "core/import/limits.h"
#include "core/types/model.h"
#include "core/types/result.h"

namespace semblante::import {

/// PLY as text or binary of either byte order. File vertices are those of the element "vertex"; reads x y z, nx ny nz
/// and s t (or u v, texture_u texture_v), faces as lists, triangle strips (element "tristrips": -1 ends a strip), and
/// skips any other element and property. The origin of texture coordinates is at the bottom, as in OBJ.
Result<Model> read_ply(std::span<const std::uint8_t> bytes, const ImportLimits& limits);

}  // namespace semblante::import
