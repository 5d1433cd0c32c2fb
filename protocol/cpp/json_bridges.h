#pragma once

// For .cpp files only, as json_cursor.h.

#include <optional>

#include "core/kernel/semblante_kernel.h"
#include "protocol/cpp/json_cursor.h"

namespace semblante {

/// What the members `arkit` and `oculus` of a frame make of a face; empty where it has neither. FAP 1 of `oculus` goes
/// before that of `arkit`. Anything wrong is reported at its place.
std::optional<semblante_frame> read_json_bridges(const JsonCursor& frame);

}  // namespace semblante
