#include "core/speech/text_breaks.h"

#include <algorithm>
#include <array>
#include <span>

#include "core/types/printable.h"

namespace semblante {
namespace {

/// Before a space only: "3.5", "a.b", "e.g.".
constexpr std::array<std::string_view, 8> spaced = {".", "!", "?", "\n", "…", "؟", "۔", "।"};
constexpr std::array<std::string_view, 4> unspaced = {"。", "！", "？", "｡"};
constexpr std::array<std::string_view, 8> clause_signs = {",", ";", ":", "،", "؛", "，", "、", "；"};
/// Quotation marks and brackets, before a word and after it. A mark of one language's beginnings may end in another.
constexpr std::array<std::string_view, 14> opening = {"\"", "'", "(", "[", "{",  "“",  "‘",
                                                      "„",  "«", "¿", "¡", "「", "『", "（"};
constexpr std::array<std::string_view, 11> closing = {"\"", "'", ")", "]", "}", "”", "’", "»", "」", "』", "）"};
constexpr std::size_t long_clause = 160;  ///< letters
/// First and last characters of the marks (Unicode's categories Mn and Mc, and joiners) of scripts that write no spaces
/// between words: Thai, Lao, Tibetan, Myanmar, Khmer, kana; accents of any script; of emoji, skin tones and selectors.
constexpr std::array<CharacterRange, 22> joining = {{
    {"\u0300", "\u036F"}, {"\u0E31", "\u0E31"},         {"\u0E33", "\u0E3A"}, {"\u0E47", "\u0E4E"},
    {"\u0EB1", "\u0EB1"}, {"\u0EB3", "\u0EBC"},         {"\u0EC8", "\u0ECE"}, {"\u0F18", "\u0F19"},
    {"\u0F35", "\u0F35"}, {"\u0F37", "\u0F37"},         {"\u0F39", "\u0F39"}, {"\u0F3E", "\u0F3F"},
    {"\u0F71", "\u0F87"}, {"\u0F8D", "\u0FBC"},         {"\u102B", "\u103E"}, {"\u135D", "\u135F"},
    {"\u17B4", "\u17D3"}, {"\u200C", "\u200D"},         {"\u20D0", "\u20F0"}, {"\u3099", "\u309A"},
    {"\uFE00", "\uFE0F"}, {"\U0001F3FB", "\U0001F3FF"},
}};

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Bytes of the sign that a text ends with; 0: none of these.
std::size_t ending(std::string_view text, std::span<const std::string_view> signs) {
  for (const std::string_view sign : signs)
    if (text.ends_with(sign)) return sign.size();
  return 0;
}
bool ends_with_one(std::string_view text, std::span<const std::string_view> signs) { return ending(text, signs) > 0; }
bool ends_with_sign(std::string_view text) {
  return ends_with_one(text, clause_signs) || ends_with_one(text, spaced) || ends_with_one(text, unspaced);
}
/// A text without the spaces, quotation marks and brackets at its end.
std::string_view without_closing(std::string_view text) {
  while (!text.empty()) {
    const std::size_t bytes = is_space(text.back()) ? 1 : ending(text, closing);
    if (bytes == 0) break;
    text.remove_suffix(bytes);
  }
  return text;
}

}  // namespace

std::size_t sentence_sign(std::string_view text) {
  for (const auto signs : {std::span<const std::string_view>(spaced), std::span<const std::string_view>(unspaced)})
    for (const std::string_view sign : signs)
      if (text.starts_with(sign)) return sign.size();
  return 0;
}

std::size_t letters_of_character(std::string_view text) {
  // By the first byte of UTF-8 and the second: U+0E00 (Thai) and beyond, but not U+1E00 (Latin) to U+2FFF (signs).
  const auto byte = [text](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U; };
  const bool is_before = byte(0) < 0xE0 || (byte(0) == 0xE0 && byte(1) < 0xB8);
  const bool is_latin_or_sign = (byte(0) == 0xE1 && byte(1) >= 0xB8) || byte(0) == 0xE2;
  if (is_before || is_latin_or_sign) return 1;
  // Thai, Lao and Tibetan (U+0E00 to U+0FFF), Ethiopic (U+1200 to U+137F), Khmer (U+1780 to U+17FF).
  const bool is_spelled = (byte(0) == 0xE0 && byte(1) >= 0xB8) ||
                          (byte(0) == 0xE1 && byte(1) >= 0x88 && byte(1) < 0x8E) ||
                          (byte(0) == 0xE1 && (byte(1) == 0x9E || byte(1) == 0x9F));
  return is_spelled ? 40 : 6;
}

bool begins_in(std::string_view text, std::span<const CharacterRange> ranges) {
  // The bytes of UTF-8 have the order of the characters.
  const std::string_view character = text.substr(0, utf8_step(text));
  return std::any_of(ranges.begin(), ranges.end(), [character](const CharacterRange& range) {
    return character >= range[0] && character <= range[1];
  });
}

bool joins_before(std::string_view text) { return begins_in(text, joining); }

bool has_signs_alone(std::string_view text) {
  bool has_sign = false;
  while (!text.empty()) {
    std::size_t bytes = sentence_sign(text);
    for (const std::string_view sign : clause_signs)
      if (text.starts_with(sign)) bytes = sign.size();
    has_sign = has_sign || bytes > 0;
    if (bytes == 0 && is_space(text[0])) bytes = 1;
    if (bytes == 0) return false;
    text.remove_prefix(bytes);
  }
  return has_sign;
}

bool ends_sentence(std::string_view text, std::size_t bytes) {
  const std::string_view after = text.substr(bytes);
  return after.empty() || is_space(after[0]) || after[0] == '[' || after[0] == '<' || sentence_sign(after) > 0 ||
         ends_with_one(text.substr(0, bytes), unspaced);
}

bool is_sentence_end(std::string_view text) {
  text = without_closing(text);
  return ends_with_one(text, spaced) || ends_with_one(text, unspaced);
}

bool ends_clause(std::string_view text) {
  text = without_closing(text);
  return ends_with_one(text, clause_signs) || ends_with_one(text, unspaced);
}

std::size_t with_opening(std::string_view text, std::size_t byte) {
  while (const std::size_t bytes = ending(text.substr(0, byte), opening)) byte -= bytes;
  return byte;
}

bool may_break(std::string_view before, std::string_view after, std::size_t letters) {
  if (letters >= most_part_letters) return letters >= 2 * most_part_letters || !joins_before(after);
  if (before.empty() || after.empty()) return false;
  const bool at_space = is_space(before.back());
  if (letters >= long_part_letters)
    return at_space || (ends_with_sign(before) && !is_digit(after[0]) && !is_space(after[0]));
  if (letters < long_clause) return false;
  if (!at_space) return ends_with_one(before, clause_signs) && static_cast<unsigned char>(before.back()) >= 0x80;
  return ends_with_one(before.substr(0, before.size() - 1), clause_signs);
}

}  // namespace semblante
