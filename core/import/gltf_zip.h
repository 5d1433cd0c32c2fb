#pragma once

#include <cstdint>
#include <span>

#include "core/import/limits.h"
#include "core/types/model.h"
#include "core/types/result.h"

namespace semblante::import {

/// A zip with one .gltf and its files (only relative paths inside the zip), or with one model of another format.
/// Entries and inflated bytes are bounded; entries are inflated on demand, in memory.
Result<Model> read_gltf_zip(std::span<const std::uint8_t> bytes, const ImportLimits& limits);

}  // namespace semblante::import
