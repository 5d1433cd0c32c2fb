#include "core/import/text.h"

#include <charconv>
#include <cmath>
#include <limits>

#include "core/types/printable.h"

namespace semblante::import {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }

/// from_chars reports underflow and overflow with the same code; the exponent, or the position of the digits,
/// distinguishes them.
bool is_tiny(std::string_view token) {
  const std::size_t e = token.find_first_of("eE");
  if (e != std::string_view::npos) return token.substr(e + 1, 1) == "-";
  return token.find('.') < token.find_first_of("123456789");
}

/// What is no number, or infinite, in the C library of older Windows: "1.#QNAN0", "-1.#IND", "1.#INF00".
bool is_not_finite_on_windows(std::string_view token) {
  if (token.starts_with('-')) token.remove_prefix(1);
  return token.starts_with("1.#");
}

}  // namespace

std::string_view as_text(std::span<const std::uint8_t> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

NumberFault parse_number(std::string_view token, float& value) {
  if (token.size() > 1 && token.front() == '+' && token[1] != '-') token.remove_prefix(1);
  double parsed = 0.0;
  const auto [end, error] = std::from_chars(token.data(), token.data() + token.size(), parsed);
  if (error == std::errc::invalid_argument || end != token.data() + token.size())
    return is_not_finite_on_windows(token) ? NumberFault::not_finite : NumberFault::not_a_number;
  if (error == std::errc::result_out_of_range) {
    if (!is_tiny(token)) return NumberFault::not_finite;
    parsed = 0.0;
  }
  // from_chars accepts "nan" and "inf"; this comparison refuses both.
  if (!(std::abs(parsed) <= static_cast<double>(std::numeric_limits<float>::max()))) return NumberFault::not_finite;
  value = static_cast<float>(parsed);
  return NumberFault::none;
}

std::string_view next_token(std::string_view& rest) {
  std::size_t begin = 0;
  while (begin < rest.size() && is_blank(rest[begin])) ++begin;
  std::size_t end = begin;
  while (end < rest.size() && !is_blank(rest[end])) ++end;
  const std::string_view token = rest.substr(begin, end - begin);
  rest.remove_prefix(end);
  return token;
}

std::string shown(std::string_view token) {
  constexpr std::size_t max_shown = 40;
  const std::string_view beginning = beginning_of(token, max_shown);
  return "'" + printable(beginning) + (beginning.size() < token.size() ? "...'" : "'");
}

std::optional<std::string_view> LineReader::next() {
  if (rest_.empty()) return std::nullopt;
  const std::size_t end = rest_.find_first_of("\r\n");
  const std::string_view line = rest_.substr(0, end);
  if (end == std::string_view::npos) {
    rest_ = {};
  } else {
    rest_.remove_prefix(end + (rest_.substr(end, 2) == "\r\n" ? 2 : 1));
  }
  line_ = ++lines_read_;
  return line;
}

std::optional<std::string_view> LineReader::next_logical() {
  std::optional<std::string_view> line = next();
  if (!line || line->empty() || line->back() != '\\') return line;
  const std::size_t first = line_;
  joined_.clear();
  while (line && !line->empty() && line->back() == '\\') {
    joined_.append(line->substr(0, line->size() - 1)).push_back(' ');
    line = next();
  }
  if (line) joined_.append(*line);
  line_ = first;
  return joined_;
}

}  // namespace semblante::import
