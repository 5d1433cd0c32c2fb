#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "core/performance/performance.h"
#include "core/speech/speech.h"
#include "core/speech/utterance.h"
#include "tests/bench/readability/mouth_shape.h"
#include "tests/support/posed_face.h"

namespace semblante::bench {

/// A text with the sounds of a language.
struct Pangram {
  const char* language;  ///< BCP 47
  const char* text;
};
std::span<const Pangram> pangrams();

/// A head that speaks, and its mouth.
struct Speaker {
  explicit Speaker(const Head& head);
  /// How far the lips are apart, of MNS0.
  [[nodiscard]] double opening(const semblante_frame& frame) const;
  PosedFace face;
  std::optional<Mouth> mouth;
};
/// Our own head, and two of other makers where they are.
const std::vector<Speaker>& speakers();

/// The voice's sound of a text with the silence that a face needs. Aborts when the voice fails.
Utterance say(const char* voice_program, const Pangram& pangram, double rate = 1.0);
Performance face_of(const Utterance& said, std::string_view language, const std::vector<EmotionSpan>& emotions = {});

/// The lips at p, b and m, from a frame of 25 a second before the sound to a frame after it. Openings are shares of the
/// way from closed to an "a".
struct Closures {
  int count = 0;
  double worst = 0.0;     ///< the least opening that is seen of a sound, in the worst phase of the frames
  double worst_at = 0.0;  ///< ms
  double shortest = 0.0;  ///< ms, of a sound, in which the lips are open by less than a tenth
};
/// `phase_ms`: a divisor of 40, in steps of which openings are measured.
Closures closures(const Speaker& speaker, const Utterance& said, std::string_view language, const Performance& face,
                  double phase_ms);

/// Opening of the mouth and strength of the sound.
struct Step {
  double lag = 0.0;          ///< ms, of best correlation; positive: the mouth is late
  double correlation = 0.0;  ///< Pearson's, at that lag
  /// In vowels: of the widest opening with the mean strength, both relative to the mean of their viseme, so that an "i"
  /// is compared with other i's.
  double vowels = 0.0;
  double vowel_opening = 0.0;  ///< mean of the widest opening in vowels, as a share of "a"
  int vowel_count = 0;
};
Step in_step(const Speaker& speaker, const Utterance& said, std::string_view language, const Performance& face);

}  // namespace semblante::bench
