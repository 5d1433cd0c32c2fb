#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "core/import/limits.h"
#include "core/import/resource_reader.h"
#include "core/types/model.h"
#include "core/types/result.h"

namespace semblante::import {

/// A binary glTF 2.0. File vertices: the POSITION rows of every primitive of every mesh, in file order (README.md).
Result<Model> read_glb(std::span<const std::uint8_t> bytes, const ImportLimits& limits,
                       const ResourceReader& resources = {});

/// A glTF 2.0 JSON text with its buffers as data: URIs, or provided by `resources`.
Result<Model> read_gltf(std::string_view json, const ImportLimits& limits, const ResourceReader& resources = {});

}  // namespace semblante::import
