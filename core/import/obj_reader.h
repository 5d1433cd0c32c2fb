#pragma once

#include <cstdint>
#include <span>

#include "core/import/limits.h"
#include "core/import/resource_reader.h"
#include "core/types/model.h"
#include "core/types/result.h"

namespace semblante::import {

/// Wavefront OBJ. File vertices are the `v` lines in order, unused ones too. Polygons are split (polygon.h); `o`, `g`
/// and `usemtl` start primitives. `mtllib` is read if `resources` provides it; otherwise materials have only a name and
/// default properties. Errors have the line.
Result<Model> read_obj(std::span<const std::uint8_t> bytes, const ImportLimits& limits,
                       const ResourceReader& resources = {});

}  // namespace semblante::import
