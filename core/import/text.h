#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace semblante::import {

/// A view of the bytes as text, in any encoding.
std::string_view as_text(std::span<const std::uint8_t> bytes);

enum class NumberFault { none, not_a_number, not_finite };

/// Parses a token as one decimal number, independent of the locale. Underflow gives zero; overflow of float32, nan and
/// inf are not_finite, also as older Windows writes them ("1.#QNAN0").
NumberFault parse_number(std::string_view token, float& value);

/// The next run of characters other than blanks; empty at the end. Advances `rest`.
std::string_view next_token(std::string_view& rest);

/// "'abc'", made safe for display: truncated to 40 bytes, control characters and bytes that are no UTF-8 as '?'.
std::string shown(std::string_view token);

/// Lines with LF, CRLF or CR ends, numbered from 1.
class LineReader {
 public:
  explicit LineReader(std::string_view text) : rest_(text) {}

  /// The next line without its end; nullopt at the end of the text.
  std::optional<std::string_view> next();
  /// Like next(), but a backslash at the end of a line continues it on the next line, as in OBJ.
  std::optional<std::string_view> next_logical();

  /// Number of the line last returned (of its first line, if joined).
  [[nodiscard]] std::size_t line() const { return line_; }
  [[nodiscard]] std::string where() const { return "line " + std::to_string(line_); }
  /// The unread text.
  [[nodiscard]] std::string_view rest() const { return rest_; }

 private:
  std::string_view rest_;
  std::string joined_;
  std::size_t lines_read_ = 0;
  std::size_t line_ = 0;
};

}  // namespace semblante::import
