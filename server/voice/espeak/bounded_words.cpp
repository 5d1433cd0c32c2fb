#include "server/voice/espeak/bounded_words.h"

#include <algorithm>
#include <array>

#include "core/types/printable.h"

namespace semblante::voice {
namespace {

bool is_apostrophe(std::string_view character) {
  constexpr std::array<std::string_view, 4> signs = {"'", "’", "ʼ", "‘"};
  return std::find(signs.begin(), signs.end(), character) != signs.end();
}

}  // namespace

std::string with_bounded_words(std::string_view text, bool ssml) {
  std::string bounded;
  bounded.reserve(text.size());
  bool in_tag = false;
  int dots = 0, apostrophes = 0, letters = 0;  // of an abbreviation, of a word, since the last sign or space
  for (std::size_t at = 0; at < text.size();) {
    std::string_view character = text.substr(at, utf8_step(text.substr(at)));
    at += character.size();
    in_tag = ssml && (character == "<" || (in_tag && character != ">"));
    if (in_tag) {
      // Is not said.
    } else if (character == " " || character == "\n" || character == "\t") {
      apostrophes = letters = 0;
    } else if (character == ".") {
      letters = 0;
      if (++dots > most_signs) {
        dots = 0;
        character = ",";
      }
    } else if (is_apostrophe(character)) {
      letters = 0;
      if (++apostrophes > most_signs) {
        apostrophes = 0;
        character = " ";
      }
    } else if (++letters > 1) {
      dots = 0;
    }
    bounded += character;
  }
  return bounded;
}

}  // namespace semblante::voice
