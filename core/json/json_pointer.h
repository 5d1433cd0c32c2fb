#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace semblante {

/// A member's name as a segment of a JSON pointer: printable(), "~" and "/" escaped (RFC 6901).
std::string pointer_segment(std::string_view name);

/// Appends "/" and the segment. Pointers are for people and for programs that look at what they sent: one that would
/// exceed 1000 bytes ends with "/..." instead.
void append_to_pointer(std::string& pointer, std::string_view name);
void append_to_pointer(std::string& pointer, std::size_t index);

}  // namespace semblante
