#include "server/voice/espeak/bounded_words.h"

#include <algorithm>
#include <array>
#include <cstdlib>

#include "core/speech/characters.h"
#include "core/types/printable.h"

namespace semblante::voice {
namespace {

bool is_apostrophe(std::string_view character) {
  constexpr std::array<std::string_view, 4> signs = {"'", "’", "ʼ", "‘"};
  return std::find(signs.begin(), signs.end(), character) != signs.end();
}

/// What a character is for the library: "." for "&#46;".
std::string meaning_of(std::string_view character) {
  if (character == "&apos;") return "'";
  if (!character.starts_with("&#")) return std::string(character);
  const bool hex = character.size() > 2 && (character[2] == 'x' || character[2] == 'X');
  const std::string digits(character.substr(hex ? 3 : 2));
  const unsigned long code = std::strtoul(digits.c_str(), nullptr, hex ? 16 : 10);
  switch (code) {
    case '.':
      return ".";
    case ' ':
    case '\n':
    case '\t':
      return " ";
    case '\'':
    case 0x2018:
    case 0x2019:
    case 0x02BC:
      return "'";
    default:
      return "x";
  }
}

/// `sign` in place of a character, as long as it.
std::string in_its_place(char sign, std::string_view character) {
  return character.starts_with('&') ? sign + std::string(character.size() - 1, ' ') : std::string(1, sign);
}

}  // namespace

std::string with_bounded_words(std::string_view text, bool ssml) {
  std::string bounded;
  bounded.reserve(text.size());
  bool in_tag = false;
  int dots = 0, apostrophes = 0, letters = 0;  // of an abbreviation, of a word, since the last sign or space
  while (!text.empty()) {
    const std::string_view character = text.substr(0, ssml ? xml_character_bytes(text) : utf8_step(text));
    text.remove_prefix(character.size());
    in_tag = ssml && (character == "<" || (in_tag && character != ">"));
    const std::string meaning = in_tag ? "" : meaning_of(character);
    char instead = 0;
    if (in_tag) {
      // Is not said.
    } else if (meaning == " " || meaning == "\n" || meaning == "\t") {
      apostrophes = letters = 0;
    } else if (meaning == ".") {
      letters = 0;
      if (++dots > most_signs) {
        dots = 0;
        instead = ',';
      }
    } else if (is_apostrophe(meaning)) {
      letters = 0;
      if (++apostrophes > most_signs) {
        apostrophes = 0;
        instead = ' ';
      }
    } else if (++letters > 1) {
      dots = 0;
    }
    bounded += instead != 0 ? in_its_place(instead, character) : std::string(character);
  }
  return bounded;
}

}  // namespace semblante::voice
