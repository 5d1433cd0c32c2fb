#pragma once

#include <vector>

#include "core/speech/segments.h"
#include "core/speech/utterance.h"
#include "core/speech/wav.h"
#include "core/types/result.h"

namespace semblante {

/// The pauses of a sound: where its level stays below that of speech for `least_pause_ms`. A sound without any speech
/// is one pause.
std::vector<Interval> pauses_of(const Recording& sound);
inline constexpr double least_pause_ms = 180.0;

/// Carries what a voice said over to somebody else's recording of the same text: the sound of both is aligned by
/// dynamic time warping of cepstra (Sakoe and Chiba, 1978), first in steps of 40 ms, then of 10 ms near the coarse
/// path. Pauses are those of the recording. Time and memory are proportional to the length.
struct Alignment {
  Utterance utterance;    ///< the recording, with phonemes, words, sentences and marks of `model` at their times in it
  double distance = 0.0;  ///< mean distance of the aligned frames, whose coefficients have variance 1
};
/// Errors, of the sound: `empty` without speech, `mismatch` when it is more than four times faster or slower than the
/// voice.
Result<Alignment> align(const Utterance& model, const Recording& sound);

}  // namespace semblante
