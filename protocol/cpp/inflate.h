#pragma once

#include <cstdint>
#include <span>

namespace semblante {

/// Unpacks a zlib stream (RFC 1950, 1951). Returns whether `packed` is exactly one valid stream, to its last byte, of
/// exactly `raw.size()` bytes; the content of `raw` is unspecified otherwise. Allocates nothing.
bool inflate_zlib(std::span<const std::uint8_t> packed, std::span<std::uint8_t> raw);

/// CRC-32 of IEEE 802.3, as in zlib and PNG; `crc` is that of the bytes before, 0 at the beginning.
std::uint32_t crc32(std::uint32_t crc, std::span<const std::uint8_t> bytes);

}  // namespace semblante
