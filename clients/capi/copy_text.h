#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <string_view>

namespace semblante::capi {

/// A text into a field of a C struct: cut to what fits, and ended by 0.
template <std::size_t N>
void copy_text(char (&to)[N], std::string_view text) {
  const std::size_t length = std::min(text.size(), N - 1);
  std::memcpy(to, text.data(), length);
  to[length] = '\0';
}

}  // namespace semblante::capi
