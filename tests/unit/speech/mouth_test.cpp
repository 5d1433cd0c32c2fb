// The mouth of an utterance: closures, coarticulation, rest.
#include "core/speech/mouth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include <gtest/gtest.h>

#include "core/expressions/library.h"
#include "core/performance/performance.h"
#include "core/speech/speech.h"

namespace semblante {
namespace {

using namespace sounds;

/// A tone under each phoneme; "" is a pause.
Utterance utterance(const std::vector<std::pair<double, const char*>>& phonemes, double duration) {
  Utterance made;
  made.sample_rate = 8000;
  made.duration = duration;
  made.samples.assign(static_cast<std::size_t>(duration * 8), 0);
  for (std::size_t i = 0; i < phonemes.size(); ++i) {
    made.phonemes.push_back({phonemes[i].first, phonemes[i].second, Stress::primary});
    const double end = i + 1 < phonemes.size() ? phonemes[i + 1].first : duration;
    for (auto s = static_cast<std::size_t>(phonemes[i].first * 8); s < static_cast<std::size_t>(end * 8); ++s)
      made.samples[s] =
          *phonemes[i].second != 0 ? static_cast<std::int16_t>(s % 2 == 0 ? 9000 : -9000) : std::int16_t{0};
  }
  made.words.push_back({phonemes.front().first, {0, 3}});
  return made;
}

Performance performance(const Utterance& said, const char* language, std::vector<EmotionSpan> emotions = {}) {
  SpeechOptions options;
  options.language = language;
  auto compiled = Performance::compile(speech_performance(said, emotions, options));
  EXPECT_TRUE(compiled.ok()) << compiled.error().where << compiled.error().message;
  return *std::move(compiled);
}

double share_of(const semblante_frame& frame, int viseme) {
  double share = 0.0;
  if (frame.viseme1 == viseme) share += frame.viseme_blend / 63.0;
  if (frame.viseme2 == viseme) share += 1.0 - frame.viseme_blend / 63.0;
  return share;
}

TEST(Mouth, BilabialBetweenOpenVowels_ClosesWholly_ForEveryPhaseOfAFrame_AlsoAtSpeed) {
  for (const double length : {30.0, 60.0, 110.0}) {
    const auto said = utterance({{400, "a"}, {500, "p"}, {500 + length, "a"}, {700, ""}}, 1200);
    const auto face = performance(said, "pt-BR");
    for (double phase = 0.0; phase < 40.0; phase += 1.0) {
      double best = 0.0;
      for (double ms = phase; ms < 1200.0; ms += 40.0)
        if (ms >= 500.0 - 40.0 && ms <= 500.0 + length + 40.0)
          best = std::max(best, share_of(face.frame_at(ms), p_b_m));
      EXPECT_EQ(best, 1.0) << length << " ms, phase " << phase;
    }
    EXPECT_GT(share_of(face.frame_at(450), a), 0.5);
    EXPECT_GT(share_of(face.frame_at(640 + length / 4), a), 0.4);
  }
}

/// ms, the longest time around a sound in which the lips are whole.
double whole_ms(const Performance& face, double begin, double end) {
  double longest = 0.0;
  for (double ms = begin, from = begin; ms <= end; ms += 1.0) {
    if (share_of(face.frame_at(ms), p_b_m) < 1.0)
      from = ms + 1.0;
    else
      longest = std::max(longest, ms - from);
  }
  return longest;
}

TEST(Mouth, BilabialIsWhole_ForLongerThanAFrame_WhereverItBegins_AlsoInJoy) {
  for (const double length : {35.0, 60.0, 110.0})
    for (double begin = 500.0; begin < 520.0; begin += 1.0) {
      const auto said = utterance({{300, "a"}, {begin, "b"}, {begin + length, "a"}, {begin + length + 100, ""}}, 1200);
      for (const bool joy : {false, true}) {
        std::vector<EmotionSpan> emotions;
        if (joy) emotions.push_back({1, 1.0, {0, 3}});
        const auto face = performance(said, "en", emotions);
        EXPECT_GE(whole_ms(face, begin - 40.0, begin + length + 40.0), 58.0) << length << " ms from " << begin;
      }
    }
}

TEST(Mouth, ShortVowelBetweenBilabials_Opens_AndTheLipsStillClose) {
  for (const double length : {55.0, 65.0, 80.0}) {
    const double end = 500 + length;
    const auto said = utterance({{400, "m"},
                                 {500, "a"},
                                 {end, "m"},
                                 {end + 70, "a"},
                                 {end + 70 + length, "p"},
                                 {end + 140 + length, "a"},
                                 {900, ""}},
                                1400);
    const auto face = performance(said, "pt-BR");
    for (const double begin : {500.0, end + 70}) {
      double most = 0.0;
      for (double ms = begin; ms < begin + length; ms += 1.0) most = std::max(most, share_of(face.frame_at(ms), a));
      EXPECT_GE(most, 0.75) << length << " ms, vowel at " << begin;
    }
    for (const double begin : {400.0, end, end + 70 + length}) {
      double most = 0.0;
      for (double ms = begin; ms < begin + 60; ms += 1.0) most = std::max(most, share_of(face.frame_at(ms), p_b_m));
      EXPECT_EQ(most, 1.0) << length << " ms, closure at " << begin;
    }
  }
}

TEST(Mouth, WeakVowelBetweenBilabials_Opens) {
  const auto said = utterance({{400, "a"}, {500, "p"}, {535, "ə"}, {590, "b"}, {650, "a"}, {900, ""}}, 1400);
  const auto face = performance(said, "en");
  double most = 0.0;
  for (double ms = 535; ms < 590; ms += 1.0)
    most = std::max(most, share_of(face.frame_at(ms), e) + share_of(face.frame_at(ms), a));
  EXPECT_GE(most, 0.3);
}

TEST(Mouth, MovesJustBeforeTheFirstSound_AndRestsSoonAfterTheLast) {
  for (const char* vowel : {"a", "u", "i"}) {
    const auto face = performance(utterance({{600, vowel}, {800, ""}}, 1600), "pt-BR");
    for (double ms = 0; ms <= 600 - 140; ms += 5) EXPECT_EQ(share_of(face.frame_at(ms), sil), 1.0) << vowel << ms;
    EXPECT_LT(share_of(face.frame_at(600 - 30), sil), 0.95) << vowel;
    for (double ms = 800 + 250; ms < 1600; ms += 5) EXPECT_EQ(share_of(face.frame_at(ms), sil), 1.0) << vowel << ms;
    EXPECT_LT(share_of(face.frame_at(800 + 60), sil), 0.95) << vowel;
  }
}

TEST(Mouth, LipsAreRoundBeforeU_ThroughConsonants) {
  const auto rounding = [](const char* vowel) {
    const auto said = utterance({{400, "s"}, {480, "t"}, {540, vowel}, {700, ""}}, 1100);
    const auto face = performance(said, "en");
    return share_of(face.frame_at(500), u);
  };
  EXPECT_GT(rounding("uː"), 0.25);
  EXPECT_EQ(rounding("iː"), 0.0);
}

TEST(Mouth, RestsInSilence_AndDiphthongsMove) {
  const auto face = performance(utterance({{400, "aɪ"}, {700, ""}}, 1500), "en");
  for (const double ms : {0.0, 1300.0}) EXPECT_GE(share_of(face.frame_at(ms), sil), ms > 0 ? 0.97 : 0.95) << ms;
  EXPECT_GT(share_of(face.frame_at(480), a), share_of(face.frame_at(660), a) + 0.2);
  EXPECT_GT(share_of(face.frame_at(660), i), share_of(face.frame_at(460), i) + 0.2);
}

TEST(Mouth, LouderVowels_OpenWider) {
  auto said = utterance({{400, "a"}, {600, "t"}, {680, "a"}, {880, ""}}, 1300);
  for (std::size_t s = 400 * 8; s < 600 * 8; ++s) said.samples[s] /= 6;
  const auto face = performance(said, "en");
  EXPECT_LT(share_of(face.frame_at(500), a) + 0.1, share_of(face.frame_at(780), a));
}

TEST(Speech, Emotion_BeginsBeforeItsWord_AndDiesAway) {
  const auto said = utterance({{500, "a"}, {700, ""}}, 1600);
  const auto face = performance(said, "en", {{1, 1.0, {0, 3}}});
  const auto joy = [&](double ms) {
    const auto frame = face.frame_at(ms);
    return frame.expression1 == 1 ? frame.intensity1 : frame.expression2 == 1 ? frame.intensity2 : 0;
  };
  EXPECT_EQ(joy(150), 0);
  EXPECT_GT(joy(400), 10);
  EXPECT_EQ(joy(600), 63);
  EXPECT_LT(joy(1150), 40);
  EXPECT_EQ(joy(1400), 0);
  EXPECT_EQ(performance(said, "en").frame_at(600).expression1, 0);
}

TEST(Speech, HundredsOfTheSameSmiley_AreOneMood_TheStrongest) {
  const auto said = utterance({{500, "a"}, {700, ""}}, 1600);
  std::vector<EmotionSpan> moods(500, {1, 0.5, {0, 3}});
  moods.push_back({1, 0.9, {0, 3}});
  moods.push_back({1, 0.2, {0, 3}});
  const auto many = performance(said, "en", moods), one = performance(said, "en", {{1, 0.9, {0, 3}}});
  for (double ms = 0.0; ms < 1600.0; ms += 50.0)
    EXPECT_EQ(many.frame_at(ms).intensity1, one.frame_at(ms).intensity1) << ms;
}

/// The mouth by Eq. 5 and its corners' FAPs in FAP units: heights of 2.4 and 8.3, and the height of 2.2.
std::array<double, 3> heights(const semblante_frame& frame) {
  const auto y = [](const DisplacementSet& set, std::string_view point) {
    for (const Displacement& part : set.displacements)
      if (to_string(part.point) == point) return static_cast<double>(part.value.y);
    return 0.0;
  };
  std::array<double, 3> found{};
  const char* const points[] = {"2.4", "8.3", "2.2"};
  const int faps[] = {12, 59, 0};
  for (std::size_t i = 0; i < found.size(); ++i) {
    const double share = frame.viseme_blend / 63.0;
    const double viseme = share * y(viseme_library()[frame.viseme1], points[i]) +
                          (1 - share) * y(viseme_library()[frame.viseme2], points[i]);
    const double expression = frame.intensity1 / 63.0 * y(expression_library()[frame.expression1], points[i]);
    found[i] = viseme != 0.0 && expression != 0.0 ? 0.85 * viseme + 0.15 * expression : viseme + expression;
    if (faps[i] != 0 && frame.fap[faps[i]] != 0.0F) found[i] = frame.fap[faps[i]];
  }
  return found;
}

TEST(Speech, ExpressionNeverJumps_AndTheSmileIsKeptWhileSpeaking) {
  const auto said = utterance({{600, "a"}, {700, "m"}, {800, "a"}, {900, ""}}, 1800);
  const auto face = performance(said, "en", {{1, 1.0, {0, 3}}});
  auto last = heights(face.frame_at(0));
  for (double ms = 0; ms <= 1800; ms += 10) {
    const auto now = heights(face.frame_at(ms));
    const bool speaks = ms > 480 && ms < 1120;
    for (std::size_t i = 0; i < now.size() && !speaks; ++i)
      EXPECT_LE(std::abs(now[i] - last[i]), 20.0) << i << " at " << ms;  // a jump is 85 % of 340
    last = now;
    if (ms >= 620 && ms <= 880) {
      EXPECT_GE(now[0], 150.0) << ms;
      EXPECT_GE(now[1], 150.0) << ms;
    }
  }
  EXPECT_EQ(heights(face.frame_at(1790)), (std::array<double, 3>{}));
}

TEST(Speech, IsTheSameForTheSameSeed_AndBlinksAtTheEndOfAPhrase) {
  const auto said = utterance({{400, "m"}, {500, "a"}, {700, ""}, {1200, "p"}, {1300, "i"}, {1500, ""}}, 2400);
  SpeechOptions options;
  options.language = "en";
  int blinks = 0;
  for (options.seed = 0; options.seed < 20; ++options.seed) {
    const auto first = speech_performance(said, {}, options);
    const auto again = speech_performance(said, {}, options);
    ASSERT_EQ(first.cues.size(), again.cues.size());
    for (std::size_t i = 0; i < first.cues.size(); ++i) {
      EXPECT_EQ(first.cues[i].time, again.cues[i].time);
      if (std::holds_alternative<BlinkTarget>(first.cues[i].target)) {
        ++blinks;
        EXPECT_TRUE((first.cues[i].time >= 700 && first.cues[i].time < 1200) || first.cues[i].time >= 1500);
      }
    }
  }
  EXPECT_GE(blinks, 20);
}

}  // namespace
}  // namespace semblante
