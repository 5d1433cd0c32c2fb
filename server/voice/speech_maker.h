#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/performance/cue.h"
#include "core/speech/marked_text.h"
#include "core/speech/speech.h"
#include "core/speech/utterance.h"
#include "core/speech/voice_timeline.h"
#include "core/types/result.h"
#include "protocol/cpp/messages.h"
#include "server/voice/voice_process.h"
#include "server/voice/voice_protocol.h"

namespace semblante::voice {

/// A text with its marks, and how a face says it.
struct SpeechRequest {
  VoiceRequest voice;           ///< its text has marks, unless it is SSML
  std::uint8_t expression = 0;  ///< of the whole text, 0..6; a mark within it is laid over it
  double intensity = 1.0;       ///< of `expression`
  bool part = false;            ///< only first_part() of the text, as it is within the whole
  SpeechOptions face;           ///< its language is the voice's
};

/// What is said first of the text of a request, and the rest. Errors: those of first_part().
Result<TextParts> first_part_of(const VoiceRequest& request);

/// A face that says a text, with its sound.
struct Speech {
  std::string text;  ///< that was spoken, without marks
  Utterance utterance;
  PerformanceScript performance;
  std::string sounds;  ///< language of the table of its phonemes
  std::vector<std::string> warnings;
};

/// Takes the marks out of the text, has the voice speak it, faster or slower and higher or lower as the emotions want,
/// and makes the face. Blocks as speak(). Errors: those of check(), read_marked_text() and speak().
Result<Speech> make_speech(const VoiceProgram& program, const SpeechRequest& request);

/// A part of a text, to be played after the parts before it.
struct SpeechPart {
  Utterance sound;                     ///< its times begin with its first sample
  PerformanceScript face;              ///< on a clock on which the sound begins at `lead`; it goes on after the sound
  double lead = 0.0;                   ///< ms
  std::vector<SpeechText> texts = {};  ///< speech_texts() of it, on the clock of the face
};

/// A text in parts, sentence by sentence, so that the first can be heard while the others are made. Together their
/// sound is that of the whole text; only the first begins with silence, and only the last ends with it. SSML is cut
/// where first_part_of_ssml() can. One thread.
class SpeechParts {
 public:
  /// Checks the request. Errors: those of check() and read_marked_text().
  static Result<SpeechParts> read(VoiceProgram program, SpeechRequest request);

  [[nodiscard]] bool done() const { return done_; }
  /// The next part. Blocks as speak(), with `wanted`. Errors: as there; `too_large`: the parts together are longer than
  /// a speech may be.
  Result<SpeechPart> next(const std::function<bool()>& wanted = {});

 private:
  SpeechParts(VoiceProgram program, SpeechRequest request)
      : program_(std::move(program)), request_(std::move(request)) {}

  VoiceProgram program_;
  SpeechRequest request_;  ///< its text is what is left to say
  bool first_ = true, done_ = false;
  double said_ms_ = 0.0;
};

/// What somebody else has said, and how a face says it.
struct SaidRequest {
  std::string_view sound;       ///< a sound file (read_sound()); empty: there is none
  std::string text;             ///< with marks
  std::string language;         ///< BCP 47
  std::uint8_t expression = 0;  ///< of the whole text, 0..6
  double intensity = 1.0;       ///< of `expression`
  SpeechOptions face;           ///< its language is `language`
  VoiceProgram sound_reader = {};
  VoiceProgram recognizer = {};  ///< for a sound without a text; empty command: none
};
/// A longer sound is not given to a recognizer, which needs a third of its length of processor time.
inline constexpr double most_recognized_seconds = 60.0;
/// Of words; a recognizer that is less sure has heard another language, or no speech.
inline constexpr double least_confidence = 0.5;

/// What another voice has said when.
struct TimelineRequest : SaidRequest {  ///< without a text: what the timeline knows of it
  std::string_view timeline;            ///< a file of one of the formats
  std::optional<TimelineFormat> format;
};

/// The face of a timeline, on the clock of its sound, to which no silence is added. Errors: `where` begins with
/// "timeline", "audio", "text" or "language".
Result<Speech> make_speech(const TimelineRequest& request);

/// The face of a recording of the text, on its clock: `voice` speaks the text too, and what it says when is carried
/// over (core/speech/alignment.h). Without a text no voice is started: a recognizer that knows the language gives words
/// and sounds; without one, or when it fails or is not sure, the visemes are heard in the sound
/// (core/speech/hearing.h), and there are no words. A warning says which it was. Errors: `where` begins with "audio",
/// "text", "language" or "voice".
Result<Speech> make_speech(const VoiceProgram& voice, const SaidRequest& request);

}  // namespace semblante::voice
