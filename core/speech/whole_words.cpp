#include "core/speech/whole_words.h"

#include <algorithm>

#include "core/speech/characters.h"
#include "core/speech/text_breaks.h"

namespace semblante {

void keep_whole_words(Utterance& utterance, std::string_view text) {
  const Characters characters(text);
  TextRange before;
  std::erase_if(utterance.words, [&](const SpokenWord& word) {
    const TextRange& range = word.range;
    const bool is_part = range.first > before.first && range.first < before.first + before.count;
    if (is_part || has_signs_alone(characters.of(range))) return true;
    before = range;
    return false;
  });
}

}  // namespace semblante
