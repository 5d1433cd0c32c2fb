#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace semblante {

/// Number of bytes of the first character of `text`; 0 if it is not valid UTF-8 (overlong forms, surrogates).
std::size_t utf8_length(std::string_view text);

/// Number of bytes from one character to the next: that of the first one of `text`, or 1 where it is not valid UTF-8.
std::size_t utf8_step(std::string_view text);

/// The byte at which `text` stops being valid UTF-8; its size if all of it is.
std::size_t utf8_end(std::string_view text);

/// The longest beginning of `text` that has whole characters and at most `most` bytes.
std::string_view beginning_of(std::string_view text, std::size_t most);

/// Whether valid UTF-8 has a control character, a break of lines, or a character that changes the direction of the
/// text.
bool has_controls(std::string_view text);

/// Whether nothing of valid UTF-8 is seen: it is empty, or of blanks and characters that have no width.
bool is_blank(std::string_view text);

/// Makes an untrusted name safe for output: valid UTF-8, at most 200 bytes. Other bytes become '?', and so does
/// what has_controls() looks for.
std::string printable(std::string_view name);

/// A length or another measure with three significant digits, for people: "6.4", "0.0625", "4.5e+06".
std::string in_three_digits(double value);

}  // namespace semblante
