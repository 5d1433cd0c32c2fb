#include "core/speech/whole_words.h"

#include <algorithm>

#include "core/speech/characters.h"
#include "core/speech/text_breaks.h"

namespace semblante {

void keep_whole_words(Utterance& utterance, std::string_view text) {
  const Characters characters(text);
  for (SpokenWord& word : utterance.words) {
    word.range.first = std::min(word.range.first, characters.count());
    word.range.count = std::min(word.range.count, characters.count() - word.range.first);
  }
  std::size_t end = 0;
  std::erase_if(utterance.words, [&](const SpokenWord& word) {
    const TextRange& range = word.range;
    if (range.count == 0 || range.first < end || has_signs_alone(characters.of(range))) return true;
    end = range.first + range.count;
    return false;
  });
}

}  // namespace semblante
