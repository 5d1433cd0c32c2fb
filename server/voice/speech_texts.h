#pragma once

#include <vector>

#include "protocol/cpp/messages.h"
#include "server/voice/speech_maker.h"

namespace semblante::voice {

/// A speech as the messages `text` of a stream (SPEC.md, section 2.2): a message for each sentence, longer ones in
/// parts, with the visemes of the voice and the expressions of the performance. `media_time` is ms after the beginning
/// of the performance, `speech` is 0. Empty if nothing is known of the words, as of a sound without text.
std::vector<SpeechText> speech_texts(const Speech& speech);

}  // namespace semblante::voice
