#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string_view>

namespace semblante {

inline bool is_space(char c) { return c == ' ' || c == '\n' || c == '\t' || c == '\r'; }

/// A part of a text that is said alone has at least so many letters.
inline constexpr std::size_t least_part_letters = 40;
/// A part without an end of a sentence is cut between words, or after a sign, from `long_part_letters` on, and anywhere
/// at `most_part_letters`, so that a text without sentences begins before all of it is made.
inline constexpr std::size_t long_part_letters = 320, most_part_letters = 480;

/// As how many letters the character that a text begins with counts, by the time in which it is said: 1; a character of
/// East and Southeast Asia, which is a syllable or, in a voice of another language, the name of a letter, 6; one of a
/// script that the voice of espeak-ng does not read, which spells it ("Thai letter ..."), 40.
std::size_t letters_of_character(std::string_view text);

/// Number of bytes of the sign that a text begins with, if the sign can end a sentence, else 0: a newline, and those of
/// Latin, Greek, Arabic, Indic, and East Asian scripts.
std::size_t sentence_sign(std::string_view text);

/// Whether a text has nothing but signs that end sentences and clauses, and spaces, and is not empty.
bool has_signs_alone(std::string_view text);

/// Whether a sentence sign of `bytes` at the beginning of `text` ends one: before a space, another such sign, a mark or
/// a tag, and not in "3.5" or "a.b". Signs of East Asian scripts stand without spaces.
bool ends_sentence(std::string_view text, std::size_t bytes);

/// Whether a text ends with the end of a sentence, with the spaces, quotation marks and brackets after it.
bool is_sentence_end(std::string_view text);

/// Whether a text ends with the end of a clause ("," and the like, or a sign of an East Asian script that ends a
/// sentence), with the spaces, quotation marks and brackets after it.
bool ends_clause(std::string_view text);

/// Where a word that begins at a byte is written from: at the quotation marks and brackets before it.
std::size_t with_opening(std::string_view text, std::size_t byte);

/// First and last of characters that follow each other in Unicode.
using CharacterRange = std::array<std::string_view, 2>;
/// Whether the first character of a text is in one of the ranges.
bool begins_in(std::string_view text, std::span<const CharacterRange> ranges);

/// Whether a text begins with a character that is written on the one before it: vowels and tones of scripts that write
/// no spaces, accents, and what joins emoji.
bool joins_before(std::string_view text);

/// Whether a part may end between `before`, of so many letters, and `after` although no sentence ends there.
bool may_break(std::string_view before, std::string_view after, std::size_t letters);

}  // namespace semblante
