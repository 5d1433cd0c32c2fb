#include "core/bridges/oculus.h"

#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

#include "core/bridges/arkit.h"
#include "core/bridges/axis_displacements.h"
#include "core/tables/mpeg4.h"

namespace semblante {
namespace {

OculusWeights weights_with(std::initializer_list<std::pair<const char*, float>> given) {
  OculusWeights w{};
  for (const auto& [name, value] : given) w.at(find_oculus(name).value()) = value;
  return w;
}

struct Fap1 {
  int viseme1, viseme2, blend;
  bool operator==(const Fap1&) const = default;
};
Fap1 fap1_of(const OculusWeights& w) {
  const semblante_frame frame = frame_from_oculus(w).value().frame;
  return {frame.viseme1, frame.viseme2, frame.viseme_blend};
}

TEST(Oculus_Names, AreInTheOrderOfFap1) {
  // By their sounds: what FAP 1 numbers 1, 2, 7 and 10 are p b m, f v, s z and a.
  EXPECT_EQ(find_oculus("sil"), 0U);
  EXPECT_EQ(find_oculus("PP"), 1U);
  EXPECT_EQ(find_oculus("ff"), 2U);
  EXPECT_EQ(find_oculus("SS"), 7U);
  EXPECT_EQ(find_oculus("AA"), 10U);
  EXPECT_EQ(find_oculus("E"), 11U);
  EXPECT_EQ(find_oculus("ou"), 14U);
  EXPECT_EQ(mpeg4::visemes[1].name, "p_b_m");
  EXPECT_EQ(mpeg4::visemes[7].name, "s_z");
  EXPECT_EQ(mpeg4::visemes[14].name, "u");
  EXPECT_FALSE(find_oculus(""));
  EXPECT_FALSE(find_oculus("viseme_PP"));
}

TEST(FrameFromOculus, OneViseme_KeepsItsStrength) {
  EXPECT_EQ(fap1_of(weights_with({{"aa", 1.0F}})), (Fap1{10, 0, 63}));
  EXPECT_EQ(fap1_of(weights_with({{"aa", 0.5F}})), (Fap1{10, 0, 32}));
  EXPECT_EQ(fap1_of(weights_with({{"aa", 0.5F}, {"sil", 0.5F}})), (Fap1{10, 0, 32}));
  EXPECT_EQ(fap1_of(weights_with({{"sil", 1.0F}})), (Fap1{0, 0, 0}));
  EXPECT_EQ(fap1_of(OculusWeights{}), (Fap1{0, 0, 0}));
}

TEST(FrameFromOculus, TwoThatSumToOne_AreBothThere) {
  EXPECT_EQ(fap1_of(weights_with({{"aa", 0.75F}, {"PP", 0.25F}})), (Fap1{10, 1, 47}));
  EXPECT_EQ(fap1_of(weights_with({{"aa", 0.5F}, {"PP", 0.5F}})), (Fap1{1, 10, 32}));
}

TEST(FrameFromOculus, MoreThanTwo_AreTheNearestPair) {
  // 0.1 is missing, less than 1.41 times 0.3: the two strongest.
  EXPECT_EQ(fap1_of(weights_with({{"oh", 0.6F}, {"SS", 0.3F}, {"nn", 0.1F}})), (Fap1{13, 7, 41}));
  // 0.4 is missing, more than 1.41 times 0.1: the strongest alone.
  EXPECT_EQ(fap1_of(weights_with({{"oh", 0.5F}, {"SS", 0.1F}})), (Fap1{13, 0, 32}));
}

TEST(FrameFromOculus, OverOne_IsSharedOut) {
  EXPECT_EQ(fap1_of(weights_with({{"aa", 1.0F}, {"ou", 1.0F}})), (Fap1{10, 14, 32}));
}

TEST(FrameFromOculus, BadWeights_AreRefusedOrCounted) {
  OculusWeights w{};
  w[3] = std::numeric_limits<float>::quiet_NaN();
  const auto refused = frame_from_oculus(w);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::not_finite);
  EXPECT_EQ(refused.error().where, "TH");
  w[3] = -1.0F;
  w[10] = 2.0F;
  EXPECT_EQ(frame_from_oculus(w)->clamped, 2U);
  EXPECT_EQ(fap1_of(w), (Fap1{10, 0, 63}));
}

TEST(FrameFromOculus, AllVisemes_MovesTheFapsByTheSum) {
  const OculusWeights w = weights_with({{"aa", 0.4F}, {"ou", 0.3F}, {"PP", 0.2F}});
  const semblante_frame frame = frame_from_oculus(w, OculusBlend::all_visemes).value().frame;
  std::array<double, SEMBLANTE_FAP_COUNT + 1> sum{};
  for (std::size_t v = 1; v < oculus_count; ++v) {
    semblante_frame one{};
    one.viseme1 = static_cast<std::uint8_t>(v);
    one.viseme_blend = SEMBLANTE_BLEND_MAX;
    const auto moved = axis_displacements(one);
    for (std::size_t n = 3; n < sum.size(); ++n) sum[n] += static_cast<double>(w[v]) * moved[n];
  }
  for (const int n : {3, 4, 5, 6, 12, 16, 52, 60})
    EXPECT_NEAR(frame.fap[n], sum[static_cast<std::size_t>(n)], 0.01) << n;
  EXPECT_GT(std::abs(sum[3]), 50.0);
}

TEST(OculusFromFrame, Fap1_ComesBackAsItIs) {
  for (std::size_t a = 1; a < oculus_count; ++a) {
    for (std::size_t b = 0; b < oculus_count; ++b) {
      semblante_frame frame{};
      frame.viseme1 = static_cast<std::uint8_t>(a);
      frame.viseme2 = static_cast<std::uint8_t>(b);
      frame.viseme_blend = 40;
      const OculusWeights w = oculus_from_frame(frame);
      OculusWeights expected{};
      expected[a] += 40.0F / 63.0F;
      expected[b] += 23.0F / 63.0F;
      for (std::size_t v = 0; v < oculus_count; ++v) EXPECT_NEAR(w[v], expected[v], 1e-5F) << a << " " << b << " " << v;
    }
  }
}

TEST(OculusFromFrame, NeutralFace_IsSilence) {
  const OculusWeights w = oculus_from_frame(semblante_frame{});
  EXPECT_EQ(w[0], 1.0F);
  for (std::size_t v = 1; v < oculus_count; ++v) EXPECT_EQ(w[v], 0.0F);
}

TEST(OculusFromFrame, LowLevelFapsOfAViseme_AreReadAsThatViseme) {
  // Those that no other sound looks like.
  for (const char* const name : {"PP", "FF", "aa"}) {
    const semblante_frame frame =
        frame_from_oculus(weights_with({{name, 1.0F}}), OculusBlend::all_visemes).value().frame;
    semblante_frame faps_alone = frame;
    faps_alone.viseme1 = faps_alone.viseme2 = faps_alone.viseme_blend = 0;
    const OculusWeights w = oculus_from_frame(faps_alone);
    const std::size_t wanted = find_oculus(name).value();
    for (std::size_t v = 0; v < oculus_count; ++v) {
      EXPECT_TRUE(v == wanted || w[v] < w[wanted]) << name << " " << oculus_name(v);
    }
  }
}

TEST(OculusFromFrame, AnyFrame_GivesWeightsThatSumToOne) {
  std::mt19937 random(23);
  std::uniform_real_distribution<float> any(-500.0F, 500.0F);
  for (int i = 0; i < 300; ++i) {
    semblante_frame frame{};
    frame.viseme1 = static_cast<std::uint8_t>(random() % 20);
    frame.viseme2 = static_cast<std::uint8_t>(random() % 20);
    frame.viseme_blend = static_cast<std::uint8_t>(random() % 80);
    for (int k = 0; k < 10; ++k) frame.fap[3 + random() % 58] = any(random);
    const OculusWeights w = oculus_from_frame(frame);
    EXPECT_NEAR(std::accumulate(w.begin(), w.end(), 0.0F), 1.0F, 1e-5F);
    for (const float value : w) EXPECT_GE(value, 0.0F);
  }
}

// A smile does not speak.
TEST(OculusFromFrame, Expressions_DoNotCount) {
  semblante_frame frame{};
  frame.expression1 = 1;
  frame.intensity1 = SEMBLANTE_BLEND_MAX;
  EXPECT_EQ(oculus_from_frame(frame)[0], 1.0F);
}

TEST(OculusFromFrame, AnOpenJawOfArkit_IsAnA) {
  ArkitCoefficients c{};
  c[find_arkit("jawOpen").value()] = 1.0F;
  const OculusWeights w = oculus_from_frame(frame_from_arkit(c)->frame);
  for (std::size_t v = 0; v < oculus_count; ++v) {
    EXPECT_TRUE(v == 10 || w[v] < w[10]) << oculus_name(v);
  }
}

}  // namespace
}  // namespace semblante
