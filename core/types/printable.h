#pragma once

#include <string>
#include <string_view>

namespace semblante {

/// A name from outside, made safe to pass on and to show: valid UTF-8 (other bytes become '?'), no control characters,
/// at most 200 bytes.
std::string printable(std::string_view name);

}  // namespace semblante
