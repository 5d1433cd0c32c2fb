#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/performance/cue.h"
#include "core/speech/wav.h"
#include "core/types/result.h"
#include "protocol/cpp/messages.h"
#include "protocol/cpp/quantizers.h"
#include "server/api/speakers.h"
#include "server/streams/growing_source.h"
#include "server/voice/sound_coder.h"
#include "server/voice/speech_maker.h"

namespace semblante::api {

/// A speech that a stream says while the rest of it is made: of a text sentence by sentence, of a speech that has been
/// made its sound. The first second is there before it is played. One thread at a time.
class LiveSpeech {
 public:
  /// The first part of a text is made: blocks as voice::speak(). Errors: those of voice::SpeechParts.
  static Result<LiveSpeech> of_text(voice::SpeechParts parts, const QuantizerSteps& steps);
  /// `sound`: empty if there is none. Errors: those of Performance::compile(); `internal`.
  /// `texts`: its sentences (voice::speech_texts()).
  static Result<LiveSpeech> of_speech(const PerformanceScript& face, const Recording& sound,
                                      std::vector<SpeechText> texts, const QuantizerSteps& steps);

  [[nodiscard]] const std::shared_ptr<streams::GrowingSource>& source() const { return source_; }
  [[nodiscard]] bool done() const { return !parts_ && coder_.done(); }
  /// Makes the rest in a thread of `speakers`, which must outlive it, as long as somebody holds the source.
  static void make_rest(LiveSpeech speech, Speakers& speakers, std::shared_ptr<void> place);

 private:
  LiveSpeech(const QuantizerSteps& steps, voice::SoundCoder coder)
      : source_(std::make_shared<streams::GrowingSource>(steps)), coder_(std::move(coder)) {}

  Status make_all(const std::weak_ptr<streams::GrowingSource>& played, Speakers& speakers);
  static Status add_part(streams::GrowingSource& source, voice::SoundCoder& coder, voice::SpeechPart part);
  static Status add_sound(streams::GrowingSource& source, voice::SoundCoder& coder);

  std::shared_ptr<streams::GrowingSource> source_;
  voice::SoundCoder coder_;
  std::optional<voice::SpeechParts> parts_;  ///< what is left to say
};

}  // namespace semblante::api
