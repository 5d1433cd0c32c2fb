// The lines of a voice, and the face that follows from them: the first line of the input is the text that was spoken.

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "core/speech/speech.h"
#include "core/speech/wav.h"
#include "server/voice/voice_protocol.h"

using namespace semblante;

namespace {

void expect(bool fact) {
  if (!fact) std::abort();
}

constexpr double past_the_sound = 1000.0;  // ms, that an event may come

/// The times of a list do not decrease and lie within the sound, or shortly after it.
template <class Events>
void expect_in_order(const Events& events, double duration) {
  double last = 0.0;
  for (const auto& event : events) {
    expect(event.time >= last && event.time <= duration + past_the_sound);
    last = event.time;
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string_view input(reinterpret_cast<const char*>(data), size);
  const auto next_line = [&] {
    const auto end = std::min(input.find('\n'), input.size());
    const auto line = input.substr(0, end);
    input.remove_prefix(std::min(end + 1, input.size()));
    return line;
  };
  const auto text = next_line();
  voice::VoiceAnswer answer, of_recognizer;
  while (!input.empty()) {
    const auto line = next_line();
    if (const auto taken = answer.take(line); !taken) {
      expect(!taken.error().message.empty());
      return 0;
    }
    expect(of_recognizer.take(line).ok());
  }
  if (const auto heard = std::move(of_recognizer).finish_heard(past_the_sound)) {
    expect(heard->confidence >= 0.0 && heard->confidence <= 1.0 && heard->said.samples.empty());
    expect(heard->text.empty() || voice::check_text(heard->text).ok());
    expect_in_order(heard->said.words, past_the_sound);
    expect(web_vtt(heard->said, heard->text).starts_with("WEBVTT"));
  }
  const auto utterance = std::move(answer).finish();
  if (!utterance) return 0;
  expect(utterance->duration <= voice::max_seconds * 1000.0);
  expect_in_order(utterance->phonemes, utterance->duration);
  expect_in_order(utterance->words, utterance->duration);
  expect_in_order(utterance->sentences, utterance->duration);
  expect_in_order(utterance->marks, utterance->duration);
  const auto script = speech_performance(*utterance, {}, {.name = "fuzz", .language = "en", .seed = 1});
  double last = 0.0;
  for (const auto& cue : script.cues) {
    expect(cue.time >= 0.0);
    last = std::max(last, cue.time);
  }
  expect(last <= utterance->duration + past_the_sound + speech_tail_ms);
  expect(web_vtt(*utterance, text).starts_with("WEBVTT"));
  expect(wav(*utterance).size() >= 2 * utterance->samples.size());
  return 0;
}
