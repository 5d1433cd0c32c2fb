#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/json/json_cursor.h"
#include "core/types/result.h"

namespace semblante::import {

/// What EXT_meshopt_compression says of a buffer view.
struct MeshoptLayout {
  enum class Mode { attributes, triangles, indices } mode = Mode::attributes;
  enum class Filter { none, octahedral, quaternion, exponential } filter = Filter::none;
  std::size_t count = 0;   ///< elements
  std::size_t stride = 0;  ///< bytes of each
};

/// Reads count, byteStride, mode and filter; faults are kept by the cursor.
MeshoptLayout read_meshopt_layout(const JsonCursor& extension);

/// `count * stride` bytes out of compressed ones. Refuses a layout the extension does not allow, and one that announces
/// more than its bytes can hold or more than `max_bytes`, before it allocates. What comes out is any bytes at all: a
/// damaged stream may decode, so indices and numbers are to be checked by whoever reads them.
Result<std::vector<std::uint8_t>> decode_meshopt(std::span<const std::uint8_t> bytes, const MeshoptLayout& layout,
                                                 std::size_t max_bytes);

}  // namespace semblante::import
