#pragma once

#include <cstdint>

namespace semblante {

/// Lets the process have as many files open as it may, and says how many of them may be connections. `wanted`: 0 for as
/// many as there can be; a number that cannot be reached is taken back, with a warning.
std::uint32_t connections_to_serve(std::uint64_t wanted);

}  // namespace semblante
