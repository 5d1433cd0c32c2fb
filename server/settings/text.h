#pragma once

#include <cstddef>
#include <string_view>

#include "core/types/result.h"

namespace semblante::settings {

/// A text written by a user must have 1 to `max_bytes` bytes, something that is seen (is_blank() of core/types), and
/// none of the characters that has_controls() looks for. The caller sets the error's `where`.
Status check_text(std::string_view text, std::size_t max_bytes);

}  // namespace semblante::settings
