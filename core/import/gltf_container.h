#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "core/import/limits.h"
#include "core/types/result.h"

namespace semblante::import {

/// The two chunks of a GLB that glTF gives a meaning; `binary` may be empty. Views into the file's bytes.
struct GlbChunks {
  std::string_view json;
  std::span<const std::uint8_t> binary;
};

/// Checks the 12-byte header and every chunk header against the bytes that are there. Errors name the byte.
Result<GlbChunks> split_glb(std::span<const std::uint8_t> bytes);

/// Gives the bytes of a URI that is not a data: URI, or refuses. `max_bytes` bounds what may be inflated.
using ResourceReader = std::function<Result<std::vector<std::uint8_t>>(std::string_view uri, std::size_t max_bytes)>;

/// For a file that stands alone: nothing outside of it is ever read.
Result<std::vector<std::uint8_t>> refuse_resource(std::string_view uri, std::size_t max_bytes);

/// The bytes of "data:[<type>];base64,...".
Result<std::vector<std::uint8_t>> decode_data_uri(std::string_view uri, std::size_t max_bytes);

}  // namespace semblante::import
