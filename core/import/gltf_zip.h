#pragma once

#include <cstdint>
#include <span>

#include "core/import/limits.h"
#include "core/types/model.h"
#include "core/types/result.h"

namespace semblante::import {

/// A zip with one .gltf and the files it names (relative paths inside the zip, nothing else), or with one .glb. Bounded
/// in entries and in inflated bytes; entries are inflated only when they are asked for, in memory.
Result<Model> read_gltf_zip(std::span<const std::uint8_t> bytes, const ImportLimits& limits);

}  // namespace semblante::import
