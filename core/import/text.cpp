#include "core/import/text.h"

#include <charconv>
#include <cmath>
#include <limits>

namespace semblante::import {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }

/// from_chars reports underflow and overflow alike; the exponent, or where the digits are, tells them apart.
bool is_tiny(std::string_view token) {
  const std::size_t e = token.find_first_of("eE");
  if (e != std::string_view::npos) return token.substr(e + 1, 1) == "-";
  return token.find('.') < token.find_first_of("123456789");
}

/// Bytes of the character `text` begins with; 0 if it is not UTF-8 (overlong forms and surrogates are not).
std::size_t utf8_length(std::string_view text) {
  const auto byte = [&text](std::size_t i) { return static_cast<unsigned char>(i < text.size() ? text[i] : '\0'); };
  const auto follows = [&byte](std::size_t i) { return (byte(i) & 0xC0U) == 0x80U; };
  const unsigned first = byte(0);
  if (first < 0x80) return 1;
  if (first >= 0xC2 && first < 0xE0) return follows(1) ? 2 : 0;
  if (first >= 0xE0 && first < 0xF0) {
    const bool overlong = first == 0xE0 && byte(1) < 0xA0;
    const bool surrogate = first == 0xED && byte(1) >= 0xA0;
    return follows(1) && follows(2) && !overlong && !surrogate ? 3 : 0;
  }
  if (first >= 0xF0 && first < 0xF5) {
    const bool overlong = first == 0xF0 && byte(1) < 0x90;
    const bool beyond = first == 0xF4 && byte(1) >= 0x90;
    return follows(1) && follows(2) && follows(3) && !overlong && !beyond ? 4 : 0;
  }
  return 0;
}

}  // namespace

std::string_view as_text(std::span<const std::uint8_t> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

NumberFault parse_number(std::string_view token, float& value) {
  if (token.size() > 1 && token.front() == '+' && token[1] != '-') token.remove_prefix(1);
  double parsed = 0.0;
  const auto [end, error] = std::from_chars(token.data(), token.data() + token.size(), parsed);
  if (error == std::errc::invalid_argument || end != token.data() + token.size()) return NumberFault::not_a_number;
  if (error == std::errc::result_out_of_range) {
    if (!is_tiny(token)) return NumberFault::not_finite;
    parsed = 0.0;
  }
  // "nan" and "inf" are numbers to from_chars; comparing this way refuses both.
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
  std::string text = "'";
  for (const char c : token.substr(0, max_shown)) text += c >= ' ' && c <= '~' ? c : '?';
  if (token.size() > max_shown) text += "...";
  return text + "'";
}

std::string printable(std::string_view name) {
  constexpr std::size_t max_bytes = 200;
  std::string text;
  while (!name.empty()) {
    const std::size_t size = utf8_length(name);
    const bool control = size == 1 && (static_cast<unsigned char>(name[0]) < 0x20 || name[0] == 0x7F);
    const std::string_view character = size == 0 || control ? "?" : name.substr(0, size);
    if (text.size() + character.size() > max_bytes) break;
    text.append(character);
    name.remove_prefix(size == 0 ? 1 : size);
  }
  return text;
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
