#pragma once

#include <span>
#include <vector>

#include "core/performance/cue.h"
#include "core/speech/segments.h"

namespace semblante {

/// The mouth of an utterance as cues of visemes.
///
/// Coarticulation is that of Cohen and Massaro (Modeling coarticulation in synthetic visual speech, 1993): each sound
/// has targets for jaw, lips, width, protrusion and tongue, and for each of them a dominance that falls exponentially
/// with the time before and after the sound; the mouth at a time is the mean of the targets weighted by the dominances.
/// So lips are round before an "u", through consonants that leave them free. p, b and m close completely, for at least
/// `least_closure_ms`, less a step where the vowel after them is short.
///
/// A frame has two visemes (FAP 1). The pairs over time are those whose mixtures follow the trajectory of the mouth
/// best, in place and in movement: the shortest path through all pairs at steps of `mouth_step_ms`.
///
/// `expressive`: when the face has an expression. Eq. 5 gives an expression the whole mouth as soon as no viseme moves
/// it; until the expression has gone, a trace of a viseme stays, so that the mouth does not jump.
std::vector<Cue> mouth_cues(std::span<const Segment> segments, std::span<const Interval> expressive = {});
inline constexpr double mouth_step_ms = 20.0;
inline constexpr double least_closure_ms = 60.0;

}  // namespace semblante
