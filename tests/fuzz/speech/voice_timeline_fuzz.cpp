// A timeline of another voice, and the face that follows from it. The first byte chooses the format; any beyond them
// leaves the choice to the reader.

#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "core/speech/speech.h"
#include "core/speech/voice_timeline.h"

using namespace semblante;

namespace {

void expect(bool fact) {
  if (!fact) std::abort();
}

/// Times do not decrease and lie within the timeline.
template <class Events>
void expect_in_order(const Events& events, double end) {
  double last = 0.0;
  for (const auto& event : events) {
    expect(event.time >= last && event.time <= end);
    last = event.time;
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string_view file(reinterpret_cast<const char*>(data) + 1, size - 1);
  std::optional<TimelineFormat> format;
  if (const auto choice = static_cast<std::size_t>(data[0] - '0'); choice < timeline_format_names.size())
    format = static_cast<TimelineFormat>(choice);
  const auto timeline = read_voice_timeline(file, format);
  if (!timeline) {
    expect(!timeline.error().message.empty());
    return 0;
  }
  expect(!timeline->phonemes.empty() && timeline->end <= max_speech_seconds * 1000.0 + 1000.0);
  expect_in_order(timeline->phonemes, timeline->end);
  expect_in_order(timeline->words, timeline->end);
  expect_in_order(timeline->sentences, timeline->end);
  expect_in_order(timeline->marks, timeline->end);
  const std::string text = text_of(*timeline);
  const auto said = utterance_of(*timeline, text, std::nullopt);
  expect(said.ok());
  for (const SpokenWord& word : said->words) expect(word.range.first + word.range.count <= text.size());
  if (timeline->phonemes.size() > 500 || timeline->end > 60'000.0) return 0;  // faces take time
  const auto script = speech_performance(*said, {}, {.name = "fuzz", .language = "en", .seed = 1});
  for (const auto& cue : script.cues) expect(cue.time >= 0.0);
  expect(web_vtt(*said, text).starts_with("WEBVTT"));
  // Ours is read again.
  expect(read_voice_timeline(timeline_json(*said, text, "en"), TimelineFormat::semblante).ok());
  return 0;
}
