#pragma once

#include <span>
#include <vector>

#include "core/speech/loudness.h"
#include "core/speech/sounds.h"
#include "core/speech/utterance.h"

namespace semblante {

/// A sound with its time: a phoneme, or a part of a diphthong.
struct Segment {
  double begin = 0.0, end = 0.0;  ///< ms
  Sound sound{};
  Stress stress = Stress::none;
  double strength = 1.0;  ///< of jaw and lips, by stress and loudness

  [[nodiscard]] bool is_silence() const { return sound.kind == SoundKind::silence; }
  [[nodiscard]] bool is_vowel() const { return sound.kind == SoundKind::vowel || sound.kind == SoundKind::round_vowel; }
  [[nodiscard]] double middle() const { return 0.5 * (begin + end); }
};

/// ms.
struct Interval {
  double begin = 0.0, end = 0.0;
  [[nodiscard]] bool contains(double ms) const { return begin <= ms && ms <= end; }
};

/// The sounds of an utterance without gaps from 0 to its end; neighbouring pauses are one.
std::vector<Segment> segments_of(const Utterance& utterance, const SoundTable& table, const Loudness& loudness);

/// What is said in one breath: the segments between pauses, first and one past the last.
struct Phrase {
  std::size_t first = 0, last = 0;
};
std::vector<Phrase> phrases_of(std::span<const Segment> segments);

}  // namespace semblante
