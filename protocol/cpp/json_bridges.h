#pragma once

#include <cstddef>
#include <optional>

#include "core/json/json_cursor.h"
#include "core/kernel/semblante_kernel.h"

namespace semblante {

/// What the members `arkit` and `oculus` of a frame make of a face; empty where it has neither. FAP 1 of `oculus` goes
/// before that of `arkit`. Anything wrong is reported at its place. Coefficients and weights outside 0..1 are taken as
/// the nearer end; how many those were is added to `clamped`.
std::optional<semblante_frame> read_json_bridges(const JsonCursor& frame, std::size_t& clamped);

}  // namespace semblante
