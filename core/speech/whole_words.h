#pragma once

#include <string_view>

#include "core/speech/utterance.h"

namespace semblante {

/// Leaves out what is called a word and is none: signs alone ("." after a `say-as`), what begins within a word before
/// it (the digits of a number, a word that is named again), and what is not in the text. So words are in the order of
/// the text, and do not overlap. `text`: the one that was spoken.
void keep_whole_words(Utterance& utterance, std::string_view text);

}  // namespace semblante
