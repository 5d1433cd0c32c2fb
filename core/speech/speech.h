#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "core/performance/cue.h"
#include "core/speech/marked_text.h"
#include "core/speech/utterance.h"

namespace semblante {

/// Silence that a face needs around speech, ms: with_silence() adds it. Before it, so long as the mouth moves before a
/// sound; whoever waits for the voice hears every ms of it.
inline constexpr double speech_lead_ms = 120.0, speech_tail_ms = 700.0;

/// How much brows and head take part.
enum class SpeechStyle : std::uint8_t { calm, normal, lively };
inline constexpr std::array<std::string_view, 3> speech_style_names = {"calm", "normal", "lively"};

struct SpeechOptions {
  std::string name;
  std::string language;    ///< BCP 47; a language without a table of sounds is read by that of English
  std::uint32_t seed = 0;  ///< of what the face does beside speaking
  SpeechStyle style = SpeechStyle::normal;
};

/// The face that says an utterance: mouth, expressions, and life, as cues on the time of the sound. An expression
/// begins `emotion_lead_ms` before the first word of its range and dies away after the last. Deterministic.
PerformanceScript speech_performance(const Utterance& utterance, std::span<const EmotionSpan> emotions,
                                     const SpeechOptions& options);
inline constexpr double emotion_lead_ms = 300.0, emotion_release_ms = 600.0;

/// What is said when, as JSON: duration, the text, sentences, words with their text, phonemes with their stress, the
/// viseme of each sound, and marks; times in ms. `text`: the one that was spoken. read_voice_timeline() gives all of it
/// back, times within 0.05 ms.
std::string timeline_json(const Utterance& utterance, std::string_view text, std::string_view language);

/// The words with their times as WebVTT: a cue for each sentence or, in long ones, part of it, with a time before each
/// word. `text`: the one that was spoken.
std::string web_vtt(const Utterance& utterance, std::string_view text);

}  // namespace semblante
