#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/performance/cue.h"
#include "core/speech/speech.h"
#include "core/speech/utterance.h"
#include "core/types/result.h"
#include "server/voice/voice_process.h"
#include "server/voice/voice_protocol.h"

namespace semblante::voice {

/// A text with its marks, and how a face says it.
struct SpeechRequest {
  VoiceRequest voice;           ///< its text has marks, unless it is SSML
  std::uint8_t expression = 0;  ///< of the whole text, 0..6; a mark within it is laid over it
  double intensity = 1.0;       ///< of `expression`
  SpeechOptions face;           ///< its language is the voice's
};

/// A face that says a text, with its sound.
struct Speech {
  std::string text;  ///< that was spoken, without marks
  Utterance utterance;
  PerformanceScript performance;
  std::vector<std::string> warnings;
};

/// Takes the marks out of the text, has the voice speak it, faster or slower and higher or lower as the emotions want,
/// and makes the face. Blocks as speak(). Errors: those of check(), read_marked_text() and speak().
Result<Speech> make_speech(const VoiceProgram& program, const SpeechRequest& request);

}  // namespace semblante::voice
