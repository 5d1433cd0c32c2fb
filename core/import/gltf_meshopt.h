#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/json/json_cursor.h"
#include "core/types/result.h"

namespace semblante::import {

/// The parameters of EXT_meshopt_compression for a buffer view.
struct MeshoptLayout {
  enum class Mode { attributes, triangles, indices } mode = Mode::attributes;
  enum class Filter { none, octahedral, quaternion, exponential } filter = Filter::none;
  std::size_t count = 0;   ///< elements
  std::size_t stride = 0;  ///< bytes of each
};

/// Reads count, byteStride, mode and filter; errors are reported by the cursor.
MeshoptLayout read_meshopt_layout(const JsonCursor& extension);

/// Decompresses to `count * stride` bytes. Before allocation it refuses layouts that the extension does not allow, and
/// declared sizes impossible for the number of bytes or beyond `max_bytes`. The result is untrusted: a damaged stream
/// may decode without an error, so the caller must check indices and numbers.
Result<std::vector<std::uint8_t>> decode_meshopt(std::span<const std::uint8_t> bytes, const MeshoptLayout& layout,
                                                 std::size_t max_bytes);

}  // namespace semblante::import
