#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/types/result.h"

struct ps_decoder_s;

namespace semblante::voice {

/// A sound of English, or a pause.
struct RecognizedPhone {
  double time = 0.0;   ///< ms from the first sample of the piece
  std::string symbol;  ///< IPA; empty: a pause
};

struct RecognizedWord {
  double time = 0.0;  ///< ms from the first sample of the piece
  double end = 0.0;
  std::string text;         ///< as the dictionary spells it
  double confidence = 0.0;  ///< posterior probability, 0..1
};

struct RecognizedPiece {
  std::vector<RecognizedWord> words;
  std::vector<RecognizedPhone> phones;
};

/// English by libpocketsphinx with Debian's model: the words by its language model, then their sounds, as the
/// dictionary has them, aligned with the same sound by a grammar of nothing else.
class Recognizer {
 public:
  static constexpr std::uint32_t sample_rate = 16'000;  ///< of the model

  /// Reads the model; afterwards no file is opened. Error `missing`: it is not installed.
  static Result<Recognizer> load();

  /// What is said in one breath of sound at `sample_rate`. Without a word there are no phones.
  RecognizedPiece hear(std::span<const std::int16_t> samples);

 private:
  struct Free {
    void operator()(ps_decoder_s* decoder) const;
  };
  using Decoder = std::unique_ptr<ps_decoder_s, Free>;
  Recognizer(Decoder words, Decoder phones) : words_(std::move(words)), phones_(std::move(phones)) {}

  std::vector<RecognizedPhone> align(std::span<const std::int16_t> samples, const std::vector<std::string>& phones);

  Decoder words_, phones_;
};

}  // namespace semblante::voice
