#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace semblante {

/// A member name as a segment of a JSON pointer: printable(), with "~" and "/" escaped (RFC 6901).
std::string pointer_segment(std::string_view name);

/// Appends "/" and the segment. A pointer that would exceed 1000 bytes ends with "/..." instead; it is for diagnosis
/// only.
void append_to_pointer(std::string& pointer, std::string_view name);
void append_to_pointer(std::string& pointer, std::size_t index);

}  // namespace semblante
