#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace semblante {

// Limits of a speech, whoever makes it.
inline constexpr double max_speech_seconds = 1'200.0;
inline constexpr std::size_t max_utterance_text_bytes = 20'000;
inline constexpr std::uint32_t least_sample_rate = 8'000, most_sample_rate = 48'000;

enum class Stress : std::uint8_t { none, primary, secondary };
inline constexpr std::array<std::string_view, 3> stress_names = {"none", "primary", "secondary"};

/// A sound from `time` to the next one.
struct SpokenPhoneme {
  double time = 0.0;   ///< ms
  std::string symbol;  ///< IPA; empty: a pause
  Stress stress = Stress::none;
};

/// A place in the text that was spoken, in characters (code points).
struct TextRange {
  std::size_t first = 0;
  std::size_t count = 0;
  friend bool operator==(const TextRange&, const TextRange&) = default;
};

struct SpokenWord {
  double time = 0.0;  ///< ms
  TextRange range;
};

struct SpokenSentence {
  double time = 0.0;      ///< ms
  std::size_t first = 0;  ///< its first character
};

/// A mark of SSML.
struct SpokenMark {
  double time = 0.0;  ///< ms
  std::string name;
};

/// What a voice made of a text: sound, and what is said when. The times of a list do not decrease.
struct Utterance {
  std::string voice;              ///< what made it, with its version
  std::uint32_t sample_rate = 0;  ///< Hz
  std::vector<std::int16_t> samples;
  std::vector<SpokenPhoneme> phonemes;
  std::vector<SpokenWord> words;
  std::vector<SpokenSentence> sentences;
  std::vector<SpokenMark> marks;
  double duration = 0.0;  ///< ms
};

}  // namespace semblante
