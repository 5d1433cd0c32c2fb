#pragma once

#include <string>
#include <string_view>

namespace semblante {

/// Makes an untrusted name safe for output: valid UTF-8 (other bytes become '?'), no control characters, at most 200
/// bytes.
std::string printable(std::string_view name);

}  // namespace semblante
