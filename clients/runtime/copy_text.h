#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <string_view>

namespace semblante::runtime {

/// Copies a text to a field of a C struct: truncated to its size, and zero-terminated.
template <std::size_t N>
void copy_text(char (&to)[N], std::string_view text) {
  const std::size_t length = std::min(text.size(), N - 1);
  std::memcpy(to, text.data(), length);
  to[length] = '\0';
}

}  // namespace semblante::runtime
