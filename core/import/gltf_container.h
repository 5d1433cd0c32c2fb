#pragma once

#include <cstdint>
#include <functional>
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

/// Returns the bytes of a URI that is not a data: URI, or an error. `max_bytes` bounds the inflated size.
using ResourceReader = std::function<Result<std::vector<std::uint8_t>>(std::string_view uri, std::size_t max_bytes)>;

/// The ResourceReader of a single file: refuses all URIs.
Result<std::vector<std::uint8_t>> refuse_resource(std::string_view uri, std::size_t max_bytes);

/// The bytes of "data:[<type>];base64,...".
Result<std::vector<std::uint8_t>> decode_data_uri(std::string_view uri, std::size_t max_bytes);

}  // namespace semblante::import
