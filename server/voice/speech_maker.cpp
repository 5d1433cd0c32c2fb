#include "server/voice/speech_maker.h"

#include <algorithm>
#include <utility>

#include "core/speech/loudness.h"
#include "core/speech/marked_text.h"
#include "core/speech/sounds.h"
#include "core/types/printable.h"

namespace semblante::voice {

Result<Speech> make_speech(const VoiceProgram& program, const SpeechRequest& request) {
  // Marks are read after the checks: it must be text at all.
  if (const auto checked = check(request.voice); !checked) return checked.error();
  VoiceRequest wish = request.voice;
  MarkedText marked{wish.text, {}};
  if (!wish.ssml) {
    auto read = read_marked_text(wish.text);
    if (!read) return Error{read.error().code, "/text", read.error().message};
    marked = *std::move(read);
  }
  if (request.expression != 0)
    marked.emotions.insert(marked.emotions.begin(), {request.expression, request.intensity, {0, marked.text.size()}});
  wish.text = marked.text;
  if (!wish.ssml) {
    const Prosody prosody = prosody_of(marked);
    wish.rate = std::clamp(wish.rate * prosody.rate, least_factor, most_factor);
    wish.pitch = std::clamp(wish.pitch * prosody.pitch, least_factor, most_factor);
  }
  auto spoken = speak(program, wish);
  if (!spoken) return spoken.error();
  Speech speech;
  speech.text = std::move(marked.text);
  speech.utterance = with_silence(*std::move(spoken), speech_lead_ms, speech_tail_ms);
  if (!has_sound_table(wish.language))
    speech.warnings.push_back(printable(wish.language) +
                              " has no table of sounds of its own: mouths are those of English");
  SpeechOptions face = request.face;
  face.language = wish.language;
  speech.performance = speech_performance(speech.utterance, marked.emotions, face);
  return speech;
}

}  // namespace semblante::voice
