#pragma once

#include <cstddef>
#include <string_view>

namespace semblante {

/// A part of a text that is said alone has at least so many characters.
inline constexpr std::size_t least_part_characters = 40;
/// A part with more is cut at the next word or sign, and one with `most_part_characters` anywhere, so that a text
/// without sentences is not made whole before it is heard.
inline constexpr std::size_t long_part_characters = 320, most_part_characters = 480;

/// Number of bytes of the sign that a text begins with, if the sign can end a sentence, else 0: a newline, and those of
/// Latin, Greek, Arabic, Indic, and East Asian scripts.
std::size_t sentence_sign(std::string_view text);

/// Whether a sentence sign of `bytes` at the beginning of `text` ends one: before a space, another such sign, a mark or
/// a tag, and not in "3.5" or "a.b". Signs of East Asian scripts stand without spaces.
bool ends_sentence(std::string_view text, std::size_t bytes);

/// Whether a part may end between `before`, of so many characters, and `after` although no sentence ends there.
bool may_break(std::string_view before, std::string_view after, std::size_t characters);

}  // namespace semblante
