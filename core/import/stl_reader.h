#pragma once

#include <cstdint>
#include <span>

#include "core/import/limits.h"
#include "core/types/model.h"
#include "core/types/result.h"

namespace semblante::import {

/// STL, binary or text. The format has no indices, only three positions per facet; corners at the same position (as
/// float32, -0 equal to +0) become one vertex, numbered in order of first appearance. Facet normals are ignored: they
/// are redundant.
Result<Model> read_stl(std::span<const std::uint8_t> bytes, const ImportLimits& limits);

}  // namespace semblante::import
