#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "core/import/limits.h"
#include "core/types/result.h"

namespace semblante::import {

/// The two chunks of a GLB defined by glTF; `binary` may be empty. Views into the file's bytes.
struct GlbChunks {
  std::string_view json;
  std::span<const std::uint8_t> binary;
};

/// Checks the 12-byte header and every chunk header against the size of the file. Errors have the byte offset.
Result<GlbChunks> split_glb(std::span<const std::uint8_t> bytes);

/// The bytes of "data:[<type>];base64,...".
Result<std::vector<std::uint8_t>> decode_data_uri(std::string_view uri, std::size_t max_bytes);

}  // namespace semblante::import
