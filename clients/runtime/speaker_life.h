#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "clients/runtime/semblante.h"
#include "core/types/split_mix.h"
#include "protocol/cpp/speech_score.h"

namespace semblante::runtime {

/// What the face of a client's own voice does beside speaking: it follows from the score and a seed, so that no byte of
/// it travels. The longest vowel of a phrase, which mostly has its stress, brings a nod and raised brows, the longest
/// of another long word a small nod; before a phrase the head lifts with the breath; in a long phrase the eyes look
/// aside; between phrases the head turns a little. The same sizes as core/speech/life.h. Times in ms of the score.
class SpeakerLife {
 public:
  explicit SpeakerLife(std::uint32_t seed) : random_(seed) {}

  /// A text begins.
  void begin(const SpeechScore& score);
  /// Nothing is said any more: all comes to rest.
  void end() { gestures_.clear(); }
  /// `elapsed` ms have passed, and the voice is at `position`.
  void move(double position, double elapsed);
  /// Whether a phrase has ended between the positions: a time to blink.
  [[nodiscard]] bool phrase_ends(double from, double to) const;
  [[nodiscard]] bool is_at_rest() const;
  /// Adds head, brows and eyes to the frame. `brows`: 0..1, the part of them that no expression moves.
  void show(semblante_frame& frame, double brows) const;

 private:
  enum Channel : std::uint8_t { pitch, yaw, roll, brow, eye_yaw, eye_pitch, channels };
  /// Rises, stays and falls.
  struct Gesture {
    double begin, rise, stay, fall;
    Channel channel;
    double size;  ///< degrees; of brows ENS units
    [[nodiscard]] double at(double position) const;
  };
  struct Phrase {
    std::size_t first, past;  ///< steps
    double pause;             ///< before it
  };

  [[nodiscard]] static std::vector<Phrase> phrases_of(const SpeechScore& score);
  void live(const SpeechScore& score, const Phrase& phrase);
  void add(double begin, double rise, double stay, double fall, Channel channel, double size);

  SplitMix random_;
  std::vector<Gesture> gestures_;
  std::vector<double> phrase_ends_;
  std::array<double, channels> now_{};
};

}  // namespace semblante::runtime
