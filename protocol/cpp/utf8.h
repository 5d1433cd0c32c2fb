#pragma once

#include <cstdint>
#include <span>

namespace semblante {

/// Whether the bytes are well-formed UTF-8 (no surrogates, no overlong forms, nothing above U+10FFFF).
inline bool is_utf8(std::span<const std::uint8_t> bytes) {
  for (std::size_t i = 0; i < bytes.size();) {
    const std::uint32_t lead = bytes[i++];
    if (lead < 0x80U) continue;
    const std::size_t more = lead >= 0xF0U ? 3 : lead >= 0xE0U ? 2 : 1;
    if (lead < 0xC2U || lead > 0xF4U || bytes.size() - i < more) return false;
    std::uint32_t code = lead & (0x3FU >> more);
    for (std::size_t k = 0; k < more; ++k, ++i) {
      if ((bytes[i] & 0xC0U) != 0x80U) return false;
      code = code << 6U | (bytes[i] & 0x3FU);
    }
    const bool overlong = (more == 2 && code < 0x800U) || (more == 3 && code < 0x10000U);
    if (overlong || code > 0x10FFFFU || (code >= 0xD800U && code < 0xE000U)) return false;
  }
  return true;
}

}  // namespace semblante
