#include "core/types/printable.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>

namespace semblante {
namespace {

/// Whether a character acts on the text around it in place of being shown: ASCII's controls and those of U+0080 to
/// U+009F, which some terminals obey; breaks of lines and paragraphs; and what reverses the order of the text that
/// follows, by which a name can look like another.
bool is_control(std::string_view character) {
  const auto first = static_cast<unsigned char>(character[0]);
  if (first < 0x20 || first == 0x7F) return true;
  if (character.size() == 2) return character < "\xC2\xA0";
  return (character >= "\xE2\x80\xA8" && character <= "\xE2\x80\xAE") ||  // U+2028 to U+202E
         (character >= "\xE2\x81\xA6" && character <= "\xE2\x81\xA9");    // U+2066 to U+2069
}

/// Blanks, and Unicode's characters without a shape of their own (Default_Ignorable_Code_Point), in order.
struct Range {
  std::uint32_t first, last;
};
constexpr auto unseen = std::to_array<Range>(
    {{0x20, 0x20},     {0xA0, 0xA0},       {0xAD, 0xAD},       {0x34F, 0x34F},    {0x61C, 0x61C},   {0x115F, 0x1160},
     {0x1680, 0x1680}, {0x17B4, 0x17B5},   {0x180B, 0x180F},   {0x2000, 0x200F},  {0x2028, 0x202F}, {0x205F, 0x206F},
     {0x2800, 0x2800}, {0x3000, 0x3000},   {0x3164, 0x3164},   {0xFE00, 0xFE0F},  {0xFEFF, 0xFEFF}, {0xFFA0, 0xFFA0},
     {0xFFF0, 0xFFF8}, {0x1BCA0, 0x1BCA3}, {0x1D173, 0x1D17A}, {0xE0000, 0xE0FFF}});

/// The number of a character of valid UTF-8.
std::uint32_t code_point(std::string_view character) {
  const auto first = static_cast<unsigned char>(character[0]);
  if (character.size() == 1) return first;
  std::uint32_t number = first & (0xFFU >> (character.size() + 1));
  for (const char byte : character.substr(1)) number = number << 6U | (static_cast<unsigned char>(byte) & 0x3FU);
  return number;
}

}  // namespace

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

std::size_t utf8_step(std::string_view text) { return std::max<std::size_t>(1, utf8_length(text)); }

std::size_t utf8_end(std::string_view text) {
  std::size_t at = 0;
  while (at < text.size()) {
    const std::size_t length = utf8_length(text.substr(at));
    if (length == 0) break;
    at += length;
  }
  return at;
}

std::string_view beginning_of(std::string_view text, std::size_t most) {
  std::size_t end = 0;
  while (end < text.size() && end + utf8_step(text.substr(end)) <= most) end += utf8_step(text.substr(end));
  return text.substr(0, end);
}

bool has_controls(std::string_view text) {
  for (; !text.empty(); text.remove_prefix(utf8_step(text)))
    if (is_control(text.substr(0, utf8_step(text)))) return true;
  return false;
}

bool is_blank(std::string_view text) {
  for (; !text.empty(); text.remove_prefix(utf8_step(text))) {
    const std::uint32_t number = code_point(text.substr(0, utf8_step(text)));
    const auto* range =
        std::find_if(unseen.begin(), unseen.end(), [number](const Range& one) { return number <= one.last; });
    if (range == unseen.end() || number < range->first) return false;
  }
  return true;
}

std::string printable(std::string_view name) {
  constexpr std::size_t max_bytes = 200;
  std::string text;
  while (!name.empty()) {
    const std::size_t size = utf8_length(name);
    const bool is_shown = size > 0 && !is_control(name.substr(0, size));
    const std::string_view character = is_shown ? name.substr(0, size) : "?";
    if (text.size() + character.size() > max_bytes) break;
    text.append(character);
    name.remove_prefix(utf8_step(name));
  }
  return text;
}

std::string in_three_digits(double value) {
  std::array<char, 32> digits;
  std::snprintf(digits.data(), digits.size(), "%.3g", value);
  return digits.data();
}

}  // namespace semblante
