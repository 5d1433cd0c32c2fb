#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "core/bridges/arkit.h"
#include "core/bridges/axis_displacements.h"
#include "core/tables/mpeg4.h"
#include "tests/unit/bridges/coefficients.h"

namespace semblante {
namespace {

float at(const ArkitCoefficients& c, const char* name) { return c.at(find_arkit(name).value()); }

ArkitCoefficients there_and_back(const ArkitCoefficients& c) {
  return arkit_from_frame(frame_from_arkit(c).value().frame);
}

semblante_frame fap_frame(std::initializer_list<std::pair<int, float>> faps) {
  semblante_frame frame{};
  for (const auto& [number, value] : faps) frame.fap[number] = value;
  return frame;
}

/// What trackers send: a few shapes at moderate strength.
ArkitCoefficients typical(std::mt19937& random) {
  ArkitCoefficients c{};
  std::uniform_real_distribution<float> amount(0.0F, 0.7F);
  for (int i = 0; i < 6; ++i) c[random() % arkit_count] = amount(random);
  return c;
}

TEST(ArkitFromFrame, NeutralFace_IsAllZero) {
  for (const float value : arkit_from_frame(semblante_frame{})) EXPECT_EQ(value, 0.0F);
}

TEST(ArkitFromFrame, EveryShape_ComesBackAsItself) {
  for (std::size_t s = 0; s < arkit_count; ++s) {
    const std::string_view name = arkit_name(s);
    if (name == "mouthClose") continue;  // nothing without an open jaw
    ArkitCoefficients c{};
    c[s] = 1.0F;
    const ArkitCoefficients back = there_and_back(c);
    EXPECT_GE(back[s], 0.6F) << name;
    for (std::size_t k = 0; k < arkit_count; ++k) {
      if (k == s || (name == "tongueOut" && arkit_name(k) == "jawOpen")) continue;
      EXPECT_LE(back[k], 0.45F) << name << " reads as " << arkit_name(k);
      EXPECT_LT(back[k], back[s]) << name << " reads as " << arkit_name(k);
    }
  }
}

TEST(ArkitFromFrame, ThereAndBackAndThere_IsTheSameFace) {
  std::mt19937 random(5);
  double worst = 0.0;
  double sum = 0.0;
  constexpr int faces = 400;
  for (int i = 0; i < faces; ++i) {
    const semblante_frame once = frame_from_arkit(typical(random))->frame;
    const semblante_frame twice = frame_from_arkit(arkit_from_frame(once))->frame;
    const auto a = axis_displacements(once);
    const auto b = axis_displacements(twice);
    double face = 0.0;
    for (const mpeg4::Fap& fap : mpeg4::faps) {
      if (fap.kind == mpeg4::FapKind::translation) face = std::max(face, std::abs(a[fap.number] - b[fap.number]));
    }
    worst = std::max(worst, face);
    sum += face;
  }
  // FAP units: 100 are 2 mm of lip (MNS).
  EXPECT_LE(worst, 160.0);
  EXPECT_LE(sum / faces, 25.0);
}

// FAP 3 is the jaw alone: the lips are where they were, so the mouth is shut over an open jaw.
TEST(ArkitFromFrame, JawAlone_IsAJawWithTheMouthClosed) {
  const ArkitCoefficients c = arkit_from_frame(fap_frame({{3, 400.0F}}));
  EXPECT_NEAR(at(c, "jawOpen"), 0.58F, 0.12F);
  EXPECT_GE(at(c, "mouthClose"), 0.6F * at(c, "jawOpen"));
  EXPECT_LE(at(c, "mouthClose"), at(c, "jawOpen"));
  const ArkitCoefficients parted = arkit_from_frame(fap_frame(
      {{3, 400.0F}, {5, -500.0F}, {10, -420.0F}, {11, -420.0F}, {52, -500.0F}, {57, -420.0F}, {58, -420.0F}}));
  EXPECT_GE(at(parted, "jawOpen"), 0.4F);
  EXPECT_LE(at(parted, "mouthClose"), 0.1F);
}

TEST(ArkitFromFrame, MouthClose_NeverMoreThanJawOpen) {
  std::mt19937 random(9);
  std::uniform_real_distribution<float> any(-600.0F, 600.0F);
  for (int i = 0; i < 500; ++i) {
    semblante_frame frame{};
    for (int k = 0; k < 12; ++k) frame.fap[3 + random() % 66] = any(random);
    const ArkitCoefficients c = arkit_from_frame(frame);
    EXPECT_LE(at(c, "mouthClose"), at(c, "jawOpen"));
    for (std::size_t s = 0; s < arkit_count; ++s) {
      ASSERT_GE(c[s], 0.0F) << arkit_name(s);
      ASSERT_LE(c[s], 1.0F) << arkit_name(s);
    }
  }
}

TEST(ArkitFromFrame, OppositeShapes_NeverBoth) {
  std::mt19937 random(13);
  std::uniform_real_distribution<float> any(-500.0F, 500.0F);
  for (int i = 0; i < 500; ++i) {
    semblante_frame frame{};
    for (int n = 3; n <= SEMBLANTE_FAP_COUNT; ++n)
      frame.fap[n] = n >= 23 && n <= 26 ? 80.0F * any(random) : any(random);
    const ArkitCoefficients c = arkit_from_frame(frame);
    for (const auto& [a, b] :
         {std::pair("eyeLookInLeft", "eyeLookOutLeft"), std::pair("eyeLookUpLeft", "eyeLookDownLeft"),
          std::pair("eyeLookInRight", "eyeLookOutRight"), std::pair("jawLeft", "jawRight"),
          std::pair("mouthLeft", "mouthRight")}) {
      EXPECT_LE(std::min(at(c, a), at(c, b)), 0.02F) << a;
    }
  }
}

TEST(ArkitFromFrame, Gaze_FollowsTheEyeballs) {
  const ArkitCoefficients c = arkit_from_frame(fap_frame({{23, 30543.0F}, {24, 30543.0F}, {25, -12217.0F}}));
  EXPECT_NEAR(at(c, "eyeLookOutLeft"), 0.5F, 0.001F);
  EXPECT_NEAR(at(c, "eyeLookInRight"), 0.5F, 0.001F);
  EXPECT_NEAR(at(c, "eyeLookUpLeft"), 0.2F, 0.001F);
  EXPECT_EQ(at(c, "eyeLookInLeft"), 0.0F);
  EXPECT_EQ(at(c, "eyeLookDownLeft"), 0.0F);
}

TEST(ArkitFromFrame, Lids_TellBlinkSquintAndWideApart) {
  const ArkitCoefficients shut = arkit_from_frame(fap_frame({{19, 1004.0F}, {21, 20.0F}}));
  EXPECT_GE(at(shut, "eyeBlinkLeft"), 0.95F);
  EXPECT_LE(at(shut, "eyeSquintLeft"), 0.05F);
  EXPECT_EQ(at(shut, "eyeBlinkRight"), 0.0F);
  const ArkitCoefficients half = arkit_from_frame(fap_frame({{20, 502.0F}, {22, 10.0F}}));
  EXPECT_NEAR(at(half, "eyeBlinkRight"), 0.5F, 0.03F);
  const ArkitCoefficients squint = there_and_back(coefficients_with({{"eyeSquintLeft", 0.8F}, {"eyeBlinkLeft", 0.3F}}));
  EXPECT_NEAR(at(squint, "eyeSquintLeft"), 0.8F, 0.15F);
  EXPECT_NEAR(at(squint, "eyeBlinkLeft"), 0.3F, 0.05F);
  const ArkitCoefficients wide = arkit_from_frame(fap_frame({{19, -162.0F}}));
  EXPECT_NEAR(at(wide, "eyeWideLeft"), 0.5F, 0.05F);
  EXPECT_EQ(at(wide, "eyeBlinkLeft"), 0.0F);
}

// The lids of eyes that look down are where the gaze takes them: no blink.
TEST(ArkitFromFrame, LidsThatFollowTheGaze_DoNotBlink) {
  const ArkitCoefficients c =
      there_and_back(coefficients_with({{"eyeLookDownLeft", 0.8F}, {"eyeLookDownRight", 0.8F}}));
  EXPECT_LE(at(c, "eyeBlinkLeft"), 0.01F);
  EXPECT_NEAR(at(c, "eyeLookDownLeft"), 0.8F, 0.01F);
}

TEST(ArkitFromFrame, SameOnBothSides_ReadsTheSameOnBothSides) {
  std::mt19937 random(17);
  std::uniform_real_distribution<float> any(-300.0F, 300.0F);
  for (int i = 0; i < 200; ++i) {
    semblante_frame frame{};
    for (const mpeg4::Fap& fap : mpeg4::faps) {
      if (fap.number < 3) continue;
      const float value = any(random);
      if (fap.mirror == fap.number) {
        if (fap.mirror_sign > 0) frame.fap[fap.number] = value;
      } else if (fap.mirror > fap.number) {
        frame.fap[fap.number] = value;
        frame.fap[fap.mirror] = static_cast<float>(fap.mirror_sign) * value;
      }
    }
    const ArkitCoefficients c = arkit_from_frame(frame);
    for (std::size_t s = 0; s < arkit_count; ++s) EXPECT_NEAR(c[s], c[arkit_mirror(s)], 1e-4F) << arkit_name(s);
  }
}

TEST(ArkitFromFrame, SmallChanges_ReadAlmostTheSame) {
  std::mt19937 random(19);
  for (int i = 0; i < 300; ++i) {
    const semblante_frame frame = frame_from_arkit(typical(random))->frame;
    semblante_frame near = frame;
    for (int n = 3; n <= SEMBLANTE_FAP_COUNT; ++n) {
      // One that reaches 0 would let go of what it holds against a viseme: that is a jump of FAPs, not of this reading.
      if (std::abs(near.fap[n]) > 2.0F) near.fap[n] += random() % 2 == 0 ? 1.0F : -1.0F;
    }
    const ArkitCoefficients a = arkit_from_frame(frame);
    const ArkitCoefficients b = arkit_from_frame(near);
    for (std::size_t s = 0; s < arkit_count; ++s) EXPECT_NEAR(a[s], b[s], 0.06F) << arkit_name(s);
  }
}

// FAPs 1 and 2 count too: what the library's faces look like is what a tracker would see.
TEST(ArkitFromFrame, VisemesAndExpressions_AreRead) {
  semblante_frame a{};
  a.viseme1 = 10;
  a.viseme_blend = SEMBLANTE_BLEND_MAX;
  EXPECT_GT(at(arkit_from_frame(a), "jawOpen"), 0.4F);
  semblante_frame u{};
  u.viseme1 = 14;
  u.viseme_blend = SEMBLANTE_BLEND_MAX;
  EXPECT_GT(at(arkit_from_frame(u), "mouthPucker") + at(arkit_from_frame(u), "mouthFunnel"), 0.4F);
  semblante_frame joy{};
  joy.expression1 = 1;
  joy.intensity1 = SEMBLANTE_BLEND_MAX;
  EXPECT_GT(at(arkit_from_frame(joy), "mouthSmileLeft"), 0.3F);
  semblante_frame surprise{};
  surprise.expression1 = 6;
  surprise.intensity1 = SEMBLANTE_BLEND_MAX;
  EXPECT_GT(at(arkit_from_frame(surprise), "browInnerUp"), 0.3F);
}

}  // namespace
}  // namespace semblante
