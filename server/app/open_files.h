#pragma once

#include <cstdint>

namespace semblante {

/// Raises the limit of open files to its hard limit, and returns how many of them can be connections. `wanted`: 0 for
/// the maximum; a number that cannot be reached is reduced, with a warning.
std::uint32_t connections_to_serve(std::uint64_t wanted);

}  // namespace semblante
