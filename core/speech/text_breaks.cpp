#include "core/speech/text_breaks.h"

#include <algorithm>
#include <array>
#include <span>

namespace semblante {
namespace {

/// Before a space only: "3.5", "a.b", "e.g.".
constexpr std::array<std::string_view, 8> spaced = {".", "!", "?", "\n", "…", "؟", "۔", "।"};
constexpr std::array<std::string_view, 4> unspaced = {"。", "！", "？", "｡"};
constexpr std::array<std::string_view, 7> clause_signs = {",", ";", ":", "،", "，", "、", "；"};
constexpr std::size_t long_clause = 160;  ///< characters

bool is_space(char c) { return c == ' ' || c == '\n' || c == '\t' || c == '\r'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

bool ends_with_one(std::string_view text, std::span<const std::string_view> signs) {
  return std::any_of(signs.begin(), signs.end(), [&](std::string_view sign) { return text.ends_with(sign); });
}
bool ends_with_sign(std::string_view text) {
  return ends_with_one(text, clause_signs) || ends_with_one(text, spaced) || ends_with_one(text, unspaced);
}

}  // namespace

std::size_t sentence_sign(std::string_view text) {
  for (const auto signs : {std::span<const std::string_view>(spaced), std::span<const std::string_view>(unspaced)})
    for (const std::string_view sign : signs)
      if (text.starts_with(sign)) return sign.size();
  return 0;
}

bool ends_sentence(std::string_view text, std::size_t bytes) {
  const std::string_view after = text.substr(bytes);
  return after.empty() || is_space(after[0]) || after[0] == '[' || after[0] == '<' || sentence_sign(after) > 0 ||
         ends_with_one(text.substr(0, bytes), unspaced);
}

bool may_break(std::string_view before, std::string_view after, std::size_t characters) {
  if (characters >= most_part_characters) return true;
  if (before.empty() || after.empty()) return false;
  const bool at_space = is_space(before.back());
  if (characters >= long_part_characters)
    return at_space || (ends_with_sign(before) && !is_digit(after[0]) && !is_space(after[0]));
  if (characters < long_clause) return false;
  if (!at_space) return ends_with_one(before, clause_signs) && static_cast<unsigned char>(before.back()) >= 0x80;
  return ends_with_one(before.substr(0, before.size() - 1), clause_signs);
}

}  // namespace semblante
