#pragma once

#include "core/speech/utterance.h"
#include "core/speech/wav.h"

namespace semblante {

/// What is said in a recording of which nobody has the text, in any language: its visemes as phonemes that look like
/// them, which the table of English has; no words. They are the likeliest by VisemeListener (core/listen), where a
/// change from one to the next costs `change_cost` (Viterbi, 1967), so that a viseme does not flicker for a step or
/// two. Time and memory are proportional to the length. The sound's rate is within the limits of utterance.h.
Utterance hear(Recording sound);
inline constexpr double change_cost = 1.0;  ///< negative logarithm of a probability

}  // namespace semblante
