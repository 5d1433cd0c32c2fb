#pragma once

#include <cstddef>
#include <optional>

#include "core/json/json_cursor.h"
#include "core/kernel/semblante_kernel.h"

namespace semblante {

/// Reads the members `arkit` and `oculus` of a frame; empty when it has neither. FAP 1 of `oculus` takes precedence
/// over that of `arkit`. Errors are reported at the cursor. Coefficients and weights outside 0..1 are clamped, and
/// their number is added to `clamped`.
std::optional<semblante_frame> read_json_bridges(const JsonCursor& frame, std::size_t& clamped);

}  // namespace semblante
