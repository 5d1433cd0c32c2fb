// Speech on heads against the sound, and how long somebody waits for a voice: tables on standard output.
//
//   bench_speech

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <string>

#include "server/voice/speech_maker.h"
#include "tests/bench/speech/speech_figures.h"

namespace semblante::bench {
namespace {

void print_heads() {
  std::printf(
      "closures at p b m (worst: %% of \"a\"; the shortest, ms), lag (ms) and correlation of opening and sound, of "
      "vowels with their\n"
      "loudness, mean opening of vowels (%% of \"a\")\n");
  std::printf("%-14s %-6s %-6s %4s %7s %8s %5s %6s %7s %8s\n", "head", "text", "", "pbm", "worst", "shortest", "lag",
              "corr", "vowels", "opening");
  for (const Speaker& speaker : speakers()) {
    for (const Pangram& pangram : pangrams()) {
      for (const auto& [name, rate, joy] :
           {std::tuple{"", 1.0, false}, std::tuple{"joy", 1.0, true}, std::tuple{"fast", 1.8, false}}) {
        const Utterance said = say(SEMBLANTE_VOICE_ESPEAK, pangram, rate);
        std::vector<EmotionSpan> emotions;
        if (joy) emotions.push_back({1, 1.0, {0, 1000}});
        const Performance face = face_of(said, pangram.language, emotions);
        const Closures closed = closures(speaker, said, pangram.language, face, 4.0);
        const Step step = in_step(speaker, said, pangram.language, face);
        std::printf("%-14s %-6s %-6s %4d %7.1f %8.0f %+5.0f %6.2f %7.2f %8.0f\n", speaker.face.head().name.c_str(),
                    pangram.language, name, closed.count, 100.0 * closed.worst, closed.shortest, step.lag,
                    step.correlation, step.vowels, 100.0 * step.vowel_opening);
      }
    }
  }
}

/// ms until the first sample that can be heard.
double silence_before(const Utterance& said) {
  const auto first = std::find_if(said.samples.begin(), said.samples.end(), [](int s) { return std::abs(s) > 100; });
  return 1000.0 * static_cast<double>(first - said.samples.begin()) / said.sample_rate;
}

/// ms to make it, the least of several, and the silence before the first sound.
struct Wait {
  double made = 1e9, silence = 0.0, seconds = 0.0;
};
Wait wait_for(const voice::SpeechRequest& request, int times) {
  Wait wait;
  for (int i = 0; i < times; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    const auto speech = voice::make_speech({.command = {SEMBLANTE_VOICE_ESPEAK}}, request);
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begin;
    if (!speech) {
      std::fprintf(stderr, "%s\n", speech.error().message.c_str());
      std::exit(1);
    }
    wait.made = std::min(wait.made, took.count());
    wait.silence = silence_before(speech->utterance);
    wait.seconds = speech->utterance.duration / 1000.0;
  }
  return wait;
}

void print_waits() {
  std::printf("\nfirst sound: ms to make the speech, silence before its first sound, both; s of sound\n");
  std::printf("%-6s %9s %-6s %8s %8s %8s %8s\n", "text", "bytes", "", "made", "silence", "first", "s");
  for (const Pangram& pangram : pangrams()) {
    for (const std::size_t repeated : {1U, 12U, 120U}) {
      std::string text;
      for (std::size_t i = 0; i < repeated && text.size() + 100 < voice::max_text_bytes; ++i)
        text += std::string(pangram.text) + " ";
      for (const bool part : {true, false}) {
        voice::SpeechRequest request;
        request.voice = {.text = text, .language = pangram.language, .voice = ""};
        request.part = part;
        const Wait wait = wait_for(request, repeated > 12 && !part ? 1 : 5);
        std::printf("%-6s %9zu %-6s %8.0f %8.0f %8.0f %8.1f\n", pangram.language, text.size(), part ? "part" : "whole",
                    wait.made, wait.silence, wait.made + wait.silence, wait.seconds);
      }
    }
  }
}

}  // namespace
}  // namespace semblante::bench

int main() {
  semblante::bench::print_heads();
  semblante::bench::print_waits();
}
