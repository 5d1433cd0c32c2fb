// Speech on heads, measured on the mesh against the sound: closures, and the mouth in step with the voice. Prints the
// figures.
#include "core/speech/speech.h"

#include <cmath>
#include <cstdio>

#include <gtest/gtest.h>

#include "core/performance/performance.h"
#include "core/speech/loudness.h"
#include "core/speech/segments.h"
#include "server/voice/voice_process.h"
#include "tests/bench/foldover/posed_face.h"
#include "tests/bench/readability/mouth_shape.h"

namespace semblante {
namespace {

using bench::Mouth;
using bench::PosedFace;

struct Language {
  const char* tag;
  const char* pangram;
};
constexpr Language languages[] = {
    {"pt-BR", "Um pequeno jabuti xereta viu dez cegonhas felizes. Papai bebe muito mamão."},
    {"en", "The quick brown fox jumps over a lazy dog. My baby bought a purple map above the bumpy pub."}};
constexpr double frame_ms = 40.0;
constexpr std::uint8_t viseme_a = 10, p_b_m = 1;

struct Subject {
  explicit Subject(const bench::Head& head) : face(head, WeightMethod::smooth), mouth(Mouth::find(face)) {}
  [[nodiscard]] double opening(const semblante_frame& frame) const { return mouth->measure(face.pose(frame)).opening; }
  PosedFace face;
  std::optional<Mouth> mouth;
};

/// Our own head, and two of other makers where they are.
const std::vector<Subject>& subjects() {
  static const std::vector<bench::Head> heads = bench::known_heads();
  static const std::vector<Subject> all = [] {
    std::vector<Subject> some;
    some.reserve(3);
    for (const bench::Head& head : heads)
      if (head.name != "mediapipe-canonical" && some.size() < 3) some.emplace_back(head);
    return some;
  }();
  return all;
}

Utterance say(const Language& language, double rate) {
  const voice::VoiceRequest request{.text = language.pangram, .language = language.tag, .voice = "", .rate = rate};
  auto spoken = voice::speak({.command = {SEMBLANTE_VOICE_ESPEAK}}, request);
  EXPECT_TRUE(spoken.ok()) << spoken.error().message;
  return with_silence(*std::move(spoken), speech_lead_ms, speech_tail_ms);
}

Performance face_of(const Utterance& said, const Language& language, std::vector<EmotionSpan> emotions = {}) {
  SpeechOptions options;
  options.language = language.tag;
  auto made = Performance::compile(speech_performance(said, emotions, options));
  EXPECT_TRUE(made.ok()) << made.error().where << ": " << made.error().message;
  return *std::move(made);
}

TEST(SpeechOnHeads, EveryBilabialCloses_WithinAFrame_AtSpeedAndInJoy) {
  for (const Subject& subject : subjects()) {
    const double closed = subject.opening(bench::frame_of(p_b_m, 0));
    const double open = subject.opening(bench::frame_of(viseme_a, 0));
    for (const Language& language : languages) {
      for (const auto& [rate, joy] : {std::pair{1.0, false}, std::pair{1.0, true}, std::pair{1.8, false}}) {
        const Utterance said = say(language, rate);
        std::vector<EmotionSpan> emotions;
        if (joy) emotions.push_back({1, 1.0, {0, 1000}});
        const Performance face = face_of(said, language, emotions);
        const Loudness loudness(said);
        int count = 0;
        double worst = 0.0;
        for (const Segment& segment : segments_of(said, sound_table(language.tag), loudness)) {
          if (segment.sound.kind != SoundKind::both_lips) continue;
          ++count;
          double least = 1e9;
          for (double ms = std::ceil((segment.begin - frame_ms) / frame_ms) * frame_ms; ms <= segment.end + frame_ms;
               ms += frame_ms)
            least = std::min(least, subject.opening(face.frame_at(std::max(0.0, ms))));
          worst = std::max(worst, (least - closed) / (open - closed));
          EXPECT_LE(least, closed + 0.1 * (open - closed))
              << subject.face.head().name << ", " << language.tag << " at " << segment.begin << " ms";
        }
        EXPECT_GE(count, 6);
        std::printf("%-14s %-6s rate %.1f %-4s %2d closures, the worst open by %.1f %% of \"a\"\n",
                    subject.face.head().name.c_str(), language.tag, rate, joy ? "joy" : "", count, 100.0 * worst);
      }
    }
  }
}

/// Pearson's.
double correlation(const std::vector<double>& a, const std::vector<double>& b, int lag) {
  double sa = 0, sb = 0, saa = 0, sbb = 0, sab = 0;
  int n = 0;
  for (int i = 0; i < static_cast<int>(a.size()); ++i) {
    const int j = i - lag;
    if (j < 0 || j >= static_cast<int>(b.size())) continue;
    const double x = a[static_cast<std::size_t>(i)];
    const double y = b[static_cast<std::size_t>(j)];
    sa += x, sb += y, saa += x * x, sbb += y * y, sab += x * y;
    ++n;
  }
  const double cov = sab - sa * sb / n;
  return cov / std::sqrt((saa - sa * sa / n) * (sbb - sb * sb / n));
}

TEST(SpeechOnHeads, TheMouthOpensWithTheSound) {
  constexpr double step = 20.0;
  for (const Subject& subject : subjects()) {
    for (const Language& language : languages) {
      const Utterance said = say(language, 1.0);
      const Performance face = face_of(said, language);
      const Loudness loudness(said);
      std::vector<double> openings, sound;
      for (double ms = 0.0; ms < said.duration; ms += step) {
        openings.push_back(subject.opening(face.frame_at(ms)));
        sound.push_back(std::sqrt(loudness.between(ms - 40.0, ms + 40.0)));
      }
      int best = -20;
      for (int lag = -20; lag <= 20; ++lag)
        if (correlation(openings, sound, lag) > correlation(openings, sound, best)) best = lag;
      std::printf("%-14s %-6s lag %+.0f ms, correlation %.2f\n", subject.face.head().name.c_str(), language.tag,
                  best * step, correlation(openings, sound, best));
      EXPECT_LE(std::abs(best * step), 40.0) << subject.face.head().name << ", " << language.tag;
      EXPECT_GE(correlation(openings, sound, best), 0.5) << subject.face.head().name << ", " << language.tag;
    }
  }
}

}  // namespace
}  // namespace semblante
