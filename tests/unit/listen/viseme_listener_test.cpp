// Sounds made by formula, and what is heard of them.
#include "core/listen/viseme_listener.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "core/listen/live_mouth.h"

namespace semblante {
namespace {

using std::numbers::pi;
using Heard = VisemeListener::Heard;
enum Viseme : std::size_t { sil = 0, s_z = 7, a = 10, i = 12, o = 13, u = 14 };

/// A resonance of the throat (Klatt 1980, "Software for a cascade/parallel formant synthesizer").
struct Resonance {
  double hz, width;
  double one = 0.0, two = 0.0;
  double pass(double value, double rate) {
    const double c = -std::exp(-2.0 * pi * width / rate),
                 b = 2.0 * std::exp(-pi * width / rate) * std::cos(2.0 * pi * hz / rate);
    const double out = (1.0 - b - c) * value + b * one + c * two;
    two = one;
    one = out;
    return out;
  }
};

void add_silence(std::vector<float>& sound, double ms, double rate) {
  sound.resize(sound.size() + static_cast<std::size_t>(ms * rate / 1000.0));
}

/// Pulses of a voice of 120 Hz through the throat, rising and falling in 60 ms.
void add_vowel(std::vector<float>& sound, std::vector<Resonance> throat, double ms, double rate) {
  const auto count = static_cast<std::size_t>(ms * rate / 1000.0);
  double phase = 0.0, flow = 0.0;
  std::vector<double> values(count);
  double most = 0.0;
  for (std::size_t n = 0; n < count; ++n) {
    phase += 120.0 / rate;
    double pulse = 0.0;
    if (phase >= 1.0) phase -= 1.0, pulse = 1.0;
    flow = 0.9 * flow + pulse;  // the voice falls with the frequency
    double value = flow;
    for (Resonance& one : throat) value = one.pass(value, rate);
    const double at = 1000.0 * static_cast<double>(n) / rate;
    values[n] = value * std::min({1.0, at / 60.0, (ms - at) / 60.0});
    most = std::max(most, std::abs(values[n]));
  }
  for (const double value : values) sound.push_back(static_cast<float>(0.3 * value / most));
}

void add_hiss(std::vector<float>& sound, double ms, double rate) {
  std::mt19937 random(1);
  std::normal_distribution<double> noise;
  Resonance high{5'500.0, 1'500.0};
  double before = 0.0;
  for (std::size_t n = 0; n < static_cast<std::size_t>(ms * rate / 1000.0); ++n) {
    const double value = high.pass(noise(random), rate);
    sound.push_back(static_cast<float>(0.05 * (value - before)));
    before = value;
  }
}

/// a, s, i, u with pauses between them.
std::vector<float> syllables(double rate) {
  std::vector<float> sound;
  add_silence(sound, 300, rate);
  add_vowel(sound, {{730, 80}, {1'200, 90}, {2'500, 120}, {3'500, 150}}, 250, rate);
  add_hiss(sound, 150, rate);
  add_vowel(sound, {{280, 60}, {2'250, 90}, {2'950, 120}, {3'700, 150}}, 250, rate);
  add_silence(sound, 200, rate);
  add_vowel(sound, {{310, 60}, {780, 90}, {2'250, 120}, {3'300, 150}}, 250, rate);
  add_silence(sound, 300, rate);
  return sound;
}

std::vector<Heard> heard_in(std::span<const float> sound, std::uint32_t rate, std::size_t block) {
  VisemeListener listener(rate);
  std::vector<Heard> found;
  for (std::size_t first = 0; first < sound.size(); first += block) {
    const auto part = sound.subspan(first, std::min(block, sound.size() - first));
    std::size_t taken = 0;
    for (std::size_t at = 0;;) {
      const auto heard = listener.push(part.subspan(at), taken);
      at += taken;
      if (!heard) break;
      found.push_back(*heard);
    }
  }
  return found;
}

/// The viseme with the greatest sum of probabilities from `begin` to `end`, ms.
std::size_t likeliest(const std::vector<Heard>& heard, double begin, double end) {
  std::array<double, VisemeNetwork::visemes> sum{};
  for (const Heard& one : heard)
    if (one.time >= begin && one.time < end)
      for (std::size_t v = 0; v < sum.size(); ++v) sum[v] += static_cast<double>(one.probability[v]);
  return static_cast<std::size_t>(std::max_element(sum.begin(), sum.end()) - sum.begin());
}

TEST(VisemeListener, HearsVowelsHissAndPauses_AtEveryRate) {
  for (const std::uint32_t rate : {16'000U, 22'050U, 44'100U, 48'000U}) {
    const auto heard = heard_in(syllables(rate), rate, 128);
    EXPECT_EQ(likeliest(heard, 0, 280), sil) << rate;
    EXPECT_EQ(likeliest(heard, 350, 500), a) << rate;
    EXPECT_EQ(likeliest(heard, 570, 680), s_z) << rate;
    EXPECT_EQ(likeliest(heard, 750, 900), i) << rate;
    EXPECT_EQ(likeliest(heard, 1'000, 1'120), sil) << rate;
    EXPECT_TRUE(likeliest(heard, 1'200, 1'350) == o || likeliest(heard, 1'200, 1'350) == u) << rate << ": it is round";
  }
}

TEST(VisemeListener, GainAndBlocksDoNotMatter) {
  const auto sound = syllables(16'000);
  auto quiet = sound;
  for (float& sample : quiet) sample *= 0.1F;
  const auto expected = heard_in(sound, 16'000, 128), whole = heard_in(sound, 16'000, sound.size()),
             single = heard_in(sound, 16'000, 1), soft = heard_in(quiet, 16'000, 128);
  ASSERT_EQ(whole.size(), expected.size());
  ASSERT_EQ(single.size(), expected.size());
  for (std::size_t n = 0; n < expected.size(); ++n) {
    EXPECT_EQ(whole[n].probability, expected[n].probability) << n;
    EXPECT_EQ(single[n].probability, expected[n].probability) << n;
  }
  EXPECT_EQ(likeliest(soft, 350, 500), a);
  EXPECT_EQ(likeliest(soft, 750, 900), i);
  EXPECT_NEAR(static_cast<double>(expected[45].level - soft[45].level), 20.0, 0.1);
}

TEST(VisemeListener, AnswersAfterItsDelay) {
  for (const std::uint32_t rate : {8'000U, 16'000U, 48'000U, 192'000U}) {
    VisemeListener listener(rate);
    const float sample = 0.0F;
    std::size_t taken = 0;
    std::uint64_t pushed = 0;
    for (int n = 0; n < 20; ++n) {
      std::optional<Heard> heard;
      while (!(heard = listener.push({&sample, 1}, taken)) || taken == 0)
        if (!heard) ++pushed;
      ++pushed;
      EXPECT_EQ(heard->time, 5.0 + 10.0 * n);
      EXPECT_NEAR(1000.0 * static_cast<double>(pushed) / rate - heard->time, VisemeListener::delay_ms, 0.3) << rate;
      float sum = 0.0F;
      for (const float probability : heard->probability) sum += probability;
      EXPECT_NEAR(sum, 1.0F, 1e-5F);
    }
  }
}

TEST(VisemeListener, SamplesThatAreNoNumbers_AreSilence) {
  auto sound = syllables(16'000);
  auto hostile = sound;
  for (std::size_t n = 0; n < 4'000; ++n) hostile[n] = std::numeric_limits<float>::quiet_NaN(), sound[n] = 0.0F;
  hostile[4'100] = std::numeric_limits<float>::infinity();
  sound[4'100] = 0.0F;
  const auto expected = heard_in(sound, 16'000, 100), heard = heard_in(hostile, 16'000, 100);
  for (std::size_t n = 0; n < expected.size(); ++n) EXPECT_EQ(heard[n].probability, expected[n].probability) << n;
  for (float& sample : sound) sample = std::numeric_limits<float>::max();
  for (const Heard& one : heard_in(sound, 16'000, 100)) EXPECT_TRUE(std::isfinite(one.level + one.probability[3]));
}

/// From a moment of the sound to the display frame with its mouth: what is waited for, a block of Web Audio, the
/// mouth's own smoothing, and a frame of a screen with 60 a second. What microphone, system and screen take is not in
/// it.
TEST(LiveMouth, IsWithin80MsOfTheMicrophone) {
  constexpr std::uint32_t rate = 48'000;
  constexpr double goal = 80.0, block = 1000.0 * 128.0 / rate, frame = 1000.0 / 60.0;
  const auto sound = syllables(rate);
  VisemeListener listener(rate);
  std::size_t taken = 0, pushed = 0;
  double waited = 0.0;
  while (const auto heard = listener.push(std::span(sound).subspan(pushed), taken)) {
    pushed += taken;
    waited = std::max(waited, 1000.0 * static_cast<double>(pushed) / rate - heard->time);
  }
  EXPECT_NEAR(waited, VisemeListener::delay_ms, 0.1);
  Heard vowel{}, rest{}, lips{};
  vowel.probability[a] = lips.probability[1] = rest.probability[sil] = 1.0F;
  LiveMouth mouth;
  for (int n = 0; n < 30; ++n) mouth.follow(rest);
  double smoothed = 0.0;  // the mean delay of a step
  for (int n = 0; n < 30; ++n)
    smoothed += VisemeListener::step_ms * (1.0 - static_cast<double>(mouth.follow(vowel)[a]));
  EXPECT_NEAR(smoothed, LiveMouth::delay_ms, 0.1);
  EXPECT_GT(mouth.follow(lips)[1], 0.5F) << "lips close with their first frame";
  EXPECT_LE(waited + block + smoothed + frame, goal) << "at most; lips are not smoothed";
}

TEST(LiveMouth, ClosesAtOnceAndOpensByLoudness) {
  LiveMouth mouth;
  Heard vowel{}, lips{}, rest{};
  vowel.probability[a] = 1.0F;
  vowel.level = -20.0F;
  lips.probability[1] = 1.0F;
  rest.probability[sil] = 1.0F;
  rest.level = lips.level = -60.0F;
  for (int n = 0; n < 20; ++n) mouth.follow(vowel);
  EXPECT_NEAR(mouth.follow(vowel)[a], 1.0F, 0.01F);
  vowel.level = -32.0F;
  EXPECT_NEAR(mouth.follow(vowel)[a], 0.6F, 0.05F);
  EXPECT_GT(mouth.follow(lips)[1], 0.6F);
  EXPECT_GT(mouth.follow(lips)[1], 0.75F);
  for (int n = 0; n < 20; ++n) {
    const auto& weights = mouth.follow(n % 2 == 0 ? rest : vowel);
    float sum = 0.0F;
    for (const float weight : weights) {
      EXPECT_GE(weight, 0.0F);
      sum += weight;
    }
    EXPECT_NEAR(sum, 1.0F, 1e-5F);
  }
  for (int n = 0; n < 20; ++n) mouth.follow(rest);
  EXPECT_NEAR(mouth.follow(rest)[sil], 1.0F, 0.01F);
}

}  // namespace
}  // namespace semblante
