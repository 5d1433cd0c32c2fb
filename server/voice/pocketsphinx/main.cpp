// A recognizer: reads a sound, writes what is said in it and when (server/voice/README.md), by libpocketsphinx.
#include <algorithm>
#include <cstdint>
#include <iostream>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <sys/resource.h>

#include "core/speech/alignment.h"
#include "server/jobs/isolation.h"
#include "server/voice/pocketsphinx/recognizer.h"
#include "server/voice/program.h"
#include "server/voice/resample.h"
#include "server/voice/voice_protocol.h"

namespace semblante::voice {
namespace {

constexpr double short_piece_ms = 4'000.0, long_piece_ms = 10'000.0, longest_piece_ms = 25'000.0;
constexpr double long_pause_ms = 400.0;

/// Where the sound is cut into pieces, ms: in long pauses, in any pause once a piece is long, and at last anywhere.
std::vector<double> pieces_of(const Recording& sound) {
  const double end = 1000.0 * static_cast<double>(sound.samples.size()) / sound.sample_rate;
  std::vector<double> cuts = {0.0};
  const auto cut_until = [&cuts](double next) {
    while (next - cuts.back() > longest_piece_ms) cuts.push_back(cuts.back() + longest_piece_ms);
  };
  for (const Interval& pause : pauses_of(sound)) {
    const double middle = 0.5 * (pause.begin + pause.end), length = middle - cuts.back();
    if (pause.begin <= 0.0 || pause.end >= end) continue;
    cut_until(middle);
    if (length > long_piece_ms || (length > short_piece_ms && pause.end - pause.begin > long_pause_ms))
      cuts.push_back(middle);
  }
  cut_until(end);
  cuts.push_back(end);
  return cuts;
}

int run() {
  VoiceAnswer sound;
  std::string line;
  while (std::getline(std::cin, line))
    if (const auto taken = sound.take(line); !taken) return refuse("the sound: " + taken.error().message);
  const std::string language = sound.language();
  auto given = std::move(sound).finish();
  if (!given) return refuse("the sound: " + given.error().message);
  if (language != "en" && !language.starts_with("en-"))
    return refuse("pocketsphinx has a model of English alone", "language");
  auto recognizer = Recognizer::load();
  if (!recognizer) return refuse(recognizer.error().message);
  // The sound is a stranger's: from here on the library reads it.
  const rlimit none{0, 0};
  if (::setrlimit(RLIMIT_NOFILE, &none) != 0) return refuse("cannot forbid itself to open files");
  if (const auto isolated = jobs::isolate_this_process({}, {.highest_landlock = 0}); !isolated)
    return refuse(isolated.error().message);
  const auto recording = resampled({given->sample_rate, std::move(given->samples)}, Recognizer::sample_rate);
  if (!recording) return refuse(recording.error().message);

  const auto cuts = pieces_of(*recording);
  std::string text, events;
  std::size_t characters = 0;  // of the text
  double sure = 0.0, said = 0.0;
  const auto sample_at = [&](double ms) {
    return std::min(recording->samples.size(), static_cast<std::size_t>(ms * Recognizer::sample_rate / 1000.0));
  };
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    const std::size_t first = sample_at(cuts[i]);
    const auto piece = recognizer->hear(std::span(recording->samples).subspan(first, sample_at(cuts[i + 1]) - first));
    const double last_time = cuts[i + 1];
    const auto at = [&](double time) { return std::min(cuts[i] + time, last_time); };
    if (piece.words.empty()) events += line_of(SpokenPhoneme{cuts[i], "", Stress::none});
    for (std::size_t w = 0; w < piece.words.size(); ++w) {
      const RecognizedWord& word = piece.words[w];
      if (text.size() + word.text.size() + 1 > max_text_bytes) return refuse("more is said than a text may have");
      if (!text.empty()) {
        text += ' ';
        ++characters;
      }
      if (w == 0) events += line_of(SpokenSentence{at(word.time), characters});
      const std::size_t count = word.text.size();  // the dictionary is ASCII
      events += line_of(SpokenWord{at(word.time), {characters, count}});
      text += word.text;
      characters += count;
      sure += word.confidence * (word.end - word.time);
      said += word.end - word.time;
    }
    for (const RecognizedPhone& phone : piece.phones)
      events += line_of(SpokenPhoneme{at(phone.time), phone.symbol, Stress::none});
  }
  say(header_line("pocketsphinx", Recognizer::sample_rate));
  say(heard_line(text, said > 0.0 ? sure / said : 0.0));
  say(events);
  return finish_answer();
}

}  // namespace
}  // namespace semblante::voice

int main() { return semblante::voice::run_program(semblante::voice::run); }
