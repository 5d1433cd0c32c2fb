#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "clients/runtime/semblante.h"
#include "clients/runtime/speaker_life.h"
#include "core/types/split_mix.h"
#include "protocol/cpp/speech_score.h"

namespace semblante::runtime {

/// The face of a client whose own voice speaks: what semblante.h says of semblante_speaker. Times in ms.
class Speaker {
 public:
  /// So fast the face follows a voice that is ahead of it.
  static constexpr double catch_up = 3.0;
  /// So long it waits at the end of a word for a voice that is behind; beyond that it goes on, because some voices tell
  /// the beginnings of some words only.
  static constexpr double patience = 400.0;

  explicit Speaker(std::uint32_t seed) : random_(seed), life_(seed) {}

  /// The voice begins the text of this score, at its word number `first`.
  void say(SpeechScore score, std::size_t first, double now);
  void reach(std::size_t word, double now);
  /// It has said the text, or was silenced.
  void end(double now);
  /// Writes mouth, expression and lids into a frame, and moves its head, brows and eyes. False, and it is not changed,
  /// when nothing is said and all of it has come to rest.
  bool show(double now, semblante_frame& frame);

 private:
  using Step = SpeechScore::Step;
  struct Mouth {
    std::uint8_t first = 0, second = 0;
    double share = 1.0;  ///< of the first
  };

  void advance(double now);
  void move_expressions(double elapsed);
  void blink(double now, semblante_frame& frame);
  [[nodiscard]] Mouth mouth_at(double position) const;

  std::optional<SpeechScore> score_;   ///< none: nothing is said
  std::vector<double> words_;          ///< when each begins, by the score
  double position_ = 0;                ///< in the score
  double behind_ = 0;                  ///< so much the face has still to catch up
  double speed_ = 1;                   ///< ms of the score per ms
  std::size_t next_word_ = 0;          ///< the one that the voice has not reached
  bool is_told_ = false;               ///< the voice tells words
  double waited_ = 0;                  ///< at the end of the word
  double word_at_ = 0, word_now_ = 0;  ///< the newest word: its place in the score, and when it was
  double last_ = 0;
  Mouth rest_;  ///< the mouth when the voice ended
  double ended_ = 0;
  bool was_speaking_ = false;
  std::array<double, 7> levels_{};  ///< of each expression, 0..63
  SplitMix random_;
  SpeakerLife life_;
  double blink_ = 0;  ///< when the newest blink began, or the next one begins
  double last_blink_ = 0;
};

}  // namespace semblante::runtime
