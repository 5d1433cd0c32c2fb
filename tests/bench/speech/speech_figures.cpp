#include "tests/bench/speech/speech_figures.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>

#include "core/speech/loudness.h"
#include "core/speech/segments.h"
#include "server/voice/voice_process.h"

namespace semblante::bench {
namespace {

constexpr double frame_ms = 40.0, step_ms = 20.0;
constexpr double closed_share = 0.1;  ///< of the opening of an "a": lips that look closed
constexpr std::uint8_t viseme_a = 10, p_b_m = 1;
constexpr Pangram texts[] = {
    {"pt-BR", "Um pequeno jabuti xereta viu dez cegonhas felizes. Papai bebe muito mamão."},
    {"en", "The quick brown fox jumps over a lazy dog. My baby bought a purple map above the bumpy pub."}};

/// Pearson's, of a with b so many steps earlier.
double correlation(const std::vector<double>& a, const std::vector<double>& b, int lag = 0) {
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

[[noreturn]] void give_up(const Error& error) {
  std::fprintf(stderr, "%s: %s\n", error.where.c_str(), error.message.c_str());
  std::abort();
}

}  // namespace

std::span<const Pangram> pangrams() { return texts; }

Speaker::Speaker(const Head& head) : face(head, WeightMethod::smooth), mouth(Mouth::find(face)) {}
double Speaker::opening(const semblante_frame& frame) const { return mouth->measure(face.pose(frame)).opening; }

const std::vector<Speaker>& speakers() {
  static const std::vector<Head> heads = known_heads();
  static const std::vector<Speaker> all = [] {
    std::vector<Speaker> some;
    some.reserve(3);
    for (const Head& head : heads)
      if (head.name != "mediapipe-canonical" && some.size() < 3) some.emplace_back(head);
    return some;
  }();
  return all;
}

Utterance say(const char* voice_program, const Pangram& pangram, double rate) {
  const voice::VoiceRequest request{.text = pangram.text, .language = pangram.language, .voice = "", .rate = rate};
  auto spoken = voice::speak({.command = {voice_program}}, request);
  if (!spoken) give_up(spoken.error());
  return with_silence(*std::move(spoken), speech_lead_ms, speech_tail_ms);
}

Performance face_of(const Utterance& said, std::string_view language, const std::vector<EmotionSpan>& emotions) {
  SpeechOptions options;
  options.language = language;
  auto made = Performance::compile(speech_performance(said, emotions, options));
  if (!made) give_up(made.error());
  return *std::move(made);
}

Closures closures(const Speaker& speaker, const Utterance& said, std::string_view language, const Performance& face,
                  double phase_ms) {
  const double closed = speaker.opening(frame_of(p_b_m, 0)), open = speaker.opening(frame_of(viseme_a, 0));
  Closures found;
  for (const Segment& segment : segments_of(said, sound_table(language), Loudness(said))) {
    if (segment.sound.kind != SoundKind::both_lips) continue;
    ++found.count;
    std::vector<double> openings;
    for (double ms = segment.begin - frame_ms; ms <= segment.end + frame_ms; ms += phase_ms)
      openings.push_back((speaker.opening(face.frame_at(std::max(0.0, ms))) - closed) / (open - closed));
    const auto phases = static_cast<std::size_t>(frame_ms / phase_ms);
    for (std::size_t phase = 0; phase < phases; ++phase) {
      double least = 1e9;
      for (std::size_t i = phase; i < openings.size(); i += phases) least = std::min(least, openings[i]);
      if (least <= found.worst) continue;
      found.worst = least;
      found.worst_at = segment.begin;
    }
    double whole = 0.0;
    for (std::size_t i = 0, from = 0; i < openings.size(); ++i) {
      if (openings[i] > closed_share)
        from = i + 1;
      else
        whole = std::max(whole, phase_ms * static_cast<double>(i - from));
    }
    found.shortest = found.count == 1 ? whole : std::min(found.shortest, whole);
  }
  return found;
}

Step in_step(const Speaker& speaker, const Utterance& said, std::string_view language, const Performance& face) {
  constexpr int most_steps = 20;
  const Loudness loudness(said);
  std::vector<double> openings, sound;
  for (double ms = 0.0; ms < said.duration; ms += step_ms) {
    openings.push_back(speaker.opening(face.frame_at(ms)));
    sound.push_back(std::sqrt(loudness.between(ms - 2 * step_ms, ms + 2 * step_ms)));
  }
  int best = -most_steps;
  for (int lag = -most_steps; lag <= most_steps; ++lag)
    if (correlation(openings, sound, lag) > correlation(openings, sound, best)) best = lag;
  Step step;
  step.lag = best * step_ms;
  step.correlation = correlation(openings, sound, best);

  struct Vowel {
    double opening = 0.0, loud = 0.0;
  };
  std::map<int, std::vector<Vowel>> vowels;
  const double open = speaker.opening(frame_of(viseme_a, 0));
  for (const Segment& segment : segments_of(said, sound_table(language), loudness)) {
    if (!segment.is_vowel()) continue;
    Vowel vowel{0.0, loudness.between(segment.begin, segment.end)};
    for (double ms = segment.begin; ms <= segment.end; ms += step_ms / 2)
      vowel.opening = std::max(vowel.opening, speaker.opening(face.frame_at(ms)));
    step.vowel_opening += vowel.opening / open;
    ++step.vowel_count;
    vowels[segment.sound.viseme].push_back(vowel);
  }
  step.vowel_opening /= std::max(1, step.vowel_count);
  std::vector<double> wide, loud;
  for (const auto& [viseme, all] : vowels) {
    if (all.size() < 2) continue;
    Vowel mean;
    for (const Vowel& vowel : all) mean.opening += vowel.opening / all.size(), mean.loud += vowel.loud / all.size();
    for (const Vowel& vowel : all) {
      wide.push_back(vowel.opening / mean.opening);
      loud.push_back(vowel.loud / mean.loud);
    }
  }
  step.vowels = correlation(wide, loud);
  return step;
}

}  // namespace semblante::bench
