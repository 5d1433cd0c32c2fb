#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/speech/utterance.h"
#include "core/speech/wav.h"
#include "core/types/result.h"

namespace semblante {

/// How other voices say what they speak when.
enum class TimelineFormat : std::uint8_t {
  semblante,  ///< ours: timeline_json()
  azure,      ///< events of Azure's Speech SDK, as JSON (ticks of 100 ns) or as its samples print them (ms)
  polly,      ///< speech marks of Amazon Polly: a JSON object a line
  rhubarb,    ///< Rhubarb Lip Sync's TSV, XML or JSON
  headtts,    ///< the answer of HeadTTS
  phonemes    ///< lines of begin and end in s and a phoneme in IPA, between tabs: a label track of Audacity
};
inline constexpr std::array<std::string_view, 6> timeline_format_names = {"semblante", "azure",   "polly",
                                                                          "rhubarb",   "headtts", "phonemes"};

inline constexpr std::size_t max_timeline_bytes = std::size_t{4} << 20U;
inline constexpr std::size_t max_timeline_events = 100'000;  ///< of all kinds together

/// A word or a sentence as another voice names it.
struct TimedText {
  double time = 0.0;  ///< ms
  std::string text;
  std::optional<std::size_t> first = {};  ///< its first character in VoiceTimeline::text
};

struct VoiceTimeline {
  TimelineFormat format = TimelineFormat::semblante;
  std::vector<SpokenPhoneme> phonemes;
  /// The phonemes are sounds that look like the visemes of the file; the table of English has them (viseme_symbols.h).
  bool of_visemes = false;
  std::string text;                         ///< the whole that was spoken; empty: the file has only its pieces
  std::vector<TimedText> words, sentences;  ///< a sentence with its place may have no text
  std::vector<SpokenMark> marks;
  double end = 0.0;  ///< ms: of the last of all
};

/// Reads a timeline; without a format, of the one that it looks like. Times must not decrease; symbols must be of their
/// system. Errors have a JSON pointer or a line in `where`.
Result<VoiceTimeline> read_voice_timeline(std::string_view file, std::optional<TimelineFormat> format = {});

/// What is said, as far as the timeline knows: its text, else its sentences, else its words, else nothing.
std::string text_of(const VoiceTimeline& timeline);

/// The timeline with its sound (without: `samples` are empty), and its words at their places in `text`: those that the
/// timeline names, if the text is its own, else where they are found. Words that the text does not have are left out;
/// `missing` is their number. Error: an event comes more than a second after the sound.
Result<Utterance> utterance_of(const VoiceTimeline& timeline, std::string_view text, std::optional<Recording> sound,
                               std::size_t* missing = nullptr);

}  // namespace semblante
