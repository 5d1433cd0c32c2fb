#pragma once

#include <string_view>

#include "core/speech/utterance.h"

namespace semblante {

/// Leaves out what a voice calls a word and is none: signs alone ("." after a `say-as`), and parts of a word that it
/// has named (the digits of a number). `text`: the one that was spoken.
void keep_whole_words(Utterance& utterance, std::string_view text);

}  // namespace semblante
