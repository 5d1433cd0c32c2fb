#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "core/bridges/arkit.h"
#include "core/tables/mpeg4.h"
#include "tests/unit/bridges/coefficients.h"

namespace semblante {
namespace {

semblante_frame frame_of(std::initializer_list<std::pair<const char*, float>> given) {
  return frame_from_arkit(coefficients_with(given)).value().frame;
}

ArkitCoefficients any_face(std::mt19937& random) {
  ArkitCoefficients c{};
  std::uniform_real_distribution<float> amount(0.0F, 1.0F);
  for (float& value : c) value = random() % 3 == 0 ? amount(random) : 0.0F;
  return c;
}

ArkitCoefficients mirrored(const ArkitCoefficients& c) {
  ArkitCoefficients result{};
  for (std::size_t s = 0; s < arkit_count; ++s) result[arkit_mirror(s)] = c[s];
  return result;
}

TEST(Arkit_Names, AreTheStreamsFiftyTwoInItsOrder) {
  EXPECT_EQ(arkit_name(0), "eyeBlinkLeft");
  EXPECT_EQ(arkit_name(13), "eyeWideRight");
  EXPECT_EQ(arkit_name(15), "jawLeft");
  EXPECT_EQ(arkit_name(16), "jawRight");
  EXPECT_EQ(arkit_name(17), "jawOpen");
  EXPECT_EQ(arkit_name(21), "mouthLeft");
  EXPECT_EQ(arkit_name(43), "browInnerUp");
  EXPECT_EQ(arkit_name(51), "tongueOut");
}

TEST(Arkit_Names, AreFoundInBothSpellingsAndNoOther) {
  EXPECT_EQ(find_arkit("jawOpen"), 17U);
  EXPECT_EQ(find_arkit("JawOpen"), 17U);
  for (const char* const wrong : {"", "jaw", "jawopen", "JAWOPEN", "jawOpen ", "headYaw"}) {
    EXPECT_FALSE(find_arkit(wrong)) << wrong;
  }
}

TEST(Arkit_Names, MirrorSwapsLeftAndRight) {
  for (std::size_t s = 0; s < arkit_count; ++s) {
    std::string name(arkit_name(s));
    for (const auto& [from, to] : {std::pair("Left", "Right"), std::pair("Right", "Left")}) {
      if (name.ends_with(from)) {
        name.replace(name.size() - std::string(from).size(), std::string::npos, to);
        break;
      }
    }
    EXPECT_EQ(arkit_name(arkit_mirror(s)), name);
  }
}

TEST(FrameFromArkit, NotANumber_IsRefusedByName) {
  ArkitCoefficients c{};
  c[find_arkit("mouthSmileLeft").value()] = std::numeric_limits<float>::quiet_NaN();
  const auto refused = frame_from_arkit(c);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::not_finite);
  EXPECT_EQ(refused.error().where, "mouthSmileLeft");
  c = ArkitCoefficients{};
  c[0] = std::numeric_limits<float>::infinity();
  EXPECT_FALSE(frame_from_arkit(c));
}

TEST(FrameFromArkit, OutsideZeroToOne_IsClampedAndCounted) {
  const auto over =
      frame_from_arkit(coefficients_with({{"jawOpen", 1.5F}, {"browInnerUp", -0.5F}, {"mouthFunnel", 1.0F}}));
  const auto just = frame_from_arkit(coefficients_with({{"jawOpen", 1.0F}, {"mouthFunnel", 1.0F}}));
  EXPECT_EQ(over->clamped, 2U);
  EXPECT_EQ(just->clamped, 0U);
  for (int n = 3; n <= SEMBLANTE_FAP_COUNT; ++n) EXPECT_EQ(over->frame.fap[n], just->frame.fap[n]) << n;
}

TEST(FrameFromArkit, NoCoefficient_IsTheNeutralFace) {
  const semblante_frame frame = frame_of({});
  for (int n = 0; n <= SEMBLANTE_FAP_COUNT; ++n) EXPECT_EQ(frame.fap[n], 0.0F) << n;
  EXPECT_EQ(frame.viseme1, 0);
  EXPECT_EQ(frame.viseme_blend, 0);
  EXPECT_EQ(frame.intensity1, 0);
}

TEST(FrameFromArkit, EveryShape_MovesSomething) {
  for (std::size_t s = 0; s < arkit_count; ++s) {
    // mouthClose takes back what a jaw parts, so it needs one that is open.
    if (arkit_name(s) == "mouthClose") continue;
    ArkitCoefficients c{};
    c[s] = 1.0F;
    float most = 0.0F;
    const semblante_frame frame = frame_from_arkit(c)->frame;
    for (const float fap : frame.fap) most = std::max(most, std::abs(fap));
    EXPECT_GT(most, 50.0F) << arkit_name(s);
  }
}

TEST(FrameFromArkit, AnyFace_StaysInTheRangeOfEveryFap) {
  std::mt19937 random(7);
  ArkitCoefficients all;
  all.fill(1.0F);
  for (int i = 0; i < 2000; ++i) {
    const semblante_frame frame = frame_from_arkit(i == 0 ? all : any_face(random))->frame;
    for (const mpeg4::Fap& fap : mpeg4::faps) {
      if (fap.number < 3) continue;
      ASSERT_GE(frame.fap[fap.number], static_cast<float>(fap.min())) << fap.name;
      ASSERT_LE(frame.fap[fap.number], static_cast<float>(fap.max())) << fap.name;
    }
  }
}

TEST(FrameFromArkit, MirroredCoefficients_GiveTheMirroredFace) {
  std::mt19937 random(11);
  for (int i = 0; i < 500; ++i) {
    const ArkitCoefficients c = any_face(random);
    const semblante_frame frame = frame_from_arkit(c)->frame;
    const semblante_frame other = frame_from_arkit(mirrored(c))->frame;
    EXPECT_EQ(frame.viseme1, other.viseme1);
    EXPECT_EQ(frame.viseme_blend, other.viseme_blend);
    for (const mpeg4::Fap& fap : mpeg4::faps) {
      if (fap.number < 3) continue;
      const float expected = static_cast<float>(fap.mirror_sign) * frame.fap[fap.number];
      ASSERT_NEAR(other.fap[fap.mirror], expected, 1e-3F) << fap.name;
    }
  }
}

// Lips are one muscle: what one corner does shows a little on the other side. Everything else keeps to its side.
TEST(FrameFromArkit, LeftShapes_MoveTheLeftSide) {
  for (std::size_t s = 0; s < arkit_count; ++s) {
    const std::string_view name = arkit_name(s);
    if (!name.ends_with("Left") || name == "jawLeft" || name == "mouthLeft") continue;
    ArkitCoefficients c{};
    c[s] = 1.0F;
    const semblante_frame frame = frame_from_arkit(c)->frame;
    for (const mpeg4::Fap& fap : mpeg4::faps) {
      if (fap.number < 3) continue;
      if (mpeg4::feature_points[fap.feature_points[0]].side != mpeg4::Side::right) continue;
      const float left = std::abs(frame.fap[fap.mirror]);
      const bool lip = fap.group == 2 || fap.group == 8;
      // A FAP that is held against a viseme stands at one quantizer step.
      const float held = frame.viseme_blend > 0 ? static_cast<float>(fap.quantizer_step) : 0.0F;
      EXPECT_LE(std::abs(frame.fap[fap.number]), std::max(lip ? 0.25F * left : 0.0F, held)) << name << " " << fap.name;
    }
  }
}

TEST(FrameFromArkit, JawOpen_PartsTheLipsAndMouthCloseShutsThem) {
  const semblante_frame open = frame_of({{"jawOpen", 1.0F}});
  const semblante_frame shut = frame_of({{"jawOpen", 1.0F}, {"mouthClose", 1.0F}});
  EXPECT_GT(open.fap[3], 500.0F);
  EXPECT_GT(shut.fap[3], 500.0F);
  for (const auto& [upper, lower] : {std::pair(4, 5), std::pair(8, 10), std::pair(9, 11)}) {
    // Both of a pair count towards each other: their sum is how far the lips have come together.
    EXPECT_LT(open.fap[upper] + open.fap[lower], -500.0F) << upper;
    EXPECT_GE(shut.fap[upper] + shut.fap[lower], 0.0F) << upper;
    EXPECT_LT(shut.fap[upper] + shut.fap[lower], 300.0F) << upper;
  }
}

TEST(FrameFromArkit, MouthClose_NeverMoreThanTheJawIsOpen) {
  const semblante_frame alone = frame_of({{"mouthClose", 1.0F}});
  for (int n = 3; n <= SEMBLANTE_FAP_COUNT; ++n) EXPECT_EQ(alone.fap[n], 0.0F) << n;
  const semblante_frame more = frame_of({{"jawOpen", 0.4F}, {"mouthClose", 0.9F}});
  const semblante_frame same = frame_of({{"jawOpen", 0.4F}, {"mouthClose", 0.4F}});
  for (int n = 3; n <= SEMBLANTE_FAP_COUNT; ++n) EXPECT_EQ(more.fap[n], same.fap[n]) << n;
}

TEST(FrameFromArkit, Blink_ShutsTheLidsWhateverElseTheyDo) {
  for (const auto& others :
       {coefficients_with({}), coefficients_with({{"eyeLookDownLeft", 1.0F}}),
        coefficients_with({{"eyeLookUpLeft", 1.0F}}),
        coefficients_with({{"eyeSquintLeft", 1.0F}, {"cheekSquintLeft", 1.0F}, {"mouthSmileLeft", 1.0F}}),
        coefficients_with({{"eyeWideLeft", 1.0F}})}) {
    ArkitCoefficients c = others;
    const semblante_frame open = frame_from_arkit(c)->frame;
    EXPECT_LT(open.fap[19] + open.fap[21], 900.0F);
    c[find_arkit("eyeBlinkLeft").value()] = 1.0F;
    const semblante_frame shut = frame_from_arkit(c)->frame;
    EXPECT_NEAR(shut.fap[19] + shut.fap[21], 1024.0F, 0.5F);
    EXPECT_EQ(shut.fap[20], open.fap[20]);
  }
}

// The face's own lids follow its gaze: FAPs that say it again would double it.
TEST(FrameFromArkit, Gaze_LeavesTheLidsToTheFace) {
  EXPECT_EQ(frame_of({{"eyeLookDownLeft", 1.0F}}).fap[19], 0.0F);
  EXPECT_EQ(frame_of({{"eyeLookUpLeft", 1.0F}}).fap[19], 0.0F);
}

// 35 degrees at 1. FAPs 23 and 24: positive looks to the face's left; 25 and 26: positive looks down.
TEST(FrameFromArkit, EyesLook_InOutUpDown) {
  const float full = 61086.5F;
  EXPECT_NEAR(frame_of({{"eyeLookOutLeft", 1.0F}}).fap[23], full, 1.0F);
  EXPECT_NEAR(frame_of({{"eyeLookInLeft", 1.0F}}).fap[23], -full, 1.0F);
  EXPECT_NEAR(frame_of({{"eyeLookInRight", 1.0F}}).fap[24], full, 1.0F);
  EXPECT_NEAR(frame_of({{"eyeLookOutRight", 0.5F}}).fap[24], -full / 2.0F, 1.0F);
  EXPECT_NEAR(frame_of({{"eyeLookDownLeft", 1.0F}}).fap[25], full, 1.0F);
  EXPECT_NEAR(frame_of({{"eyeLookUpRight", 1.0F}}).fap[26], -full, 1.0F);
}

TEST(FrameFromArkit, TongueOut_FindsTheLipsParted) {
  const semblante_frame frame = frame_of({{"tongueOut", 1.0F}});
  EXPECT_GT(frame.fap[45], 200.0F);
  EXPECT_LT(frame.fap[4] + frame.fap[5], -100.0F);
  // A jaw that is open already needs no more room.
  EXPECT_EQ(frame_of({{"tongueOut", 1.0F}, {"jawOpen", 0.6F}}).fap[3], frame_of({{"jawOpen", 0.6F}}).fap[3]);
}

TEST(FrameFromArkit, ManyThatClose_PressTheLipsNoFurtherThanLipsGive) {
  const semblante_frame frame = frame_of({{"mouthPressLeft", 1.0F},
                                          {"mouthPressRight", 1.0F},
                                          {"mouthShrugLower", 1.0F},
                                          {"mouthRollLower", 1.0F},
                                          {"mouthRollUpper", 1.0F}});
  EXPECT_LE(frame.fap[4] + frame.fap[5], 160.5F);
  EXPECT_GT(frame.fap[4] + frame.fap[5], 100.0F);
}

// What no FAP moves, a viseme carries; what a viseme moves and no coefficient does, is held.
TEST(FrameFromArkit, JawAndPucker_AreCarriedByAVisemeThatJumpsNowhere) {
  EXPECT_EQ(frame_of({{"jawOpen", 1.0F}}).viseme1, 10);
  EXPECT_GT(frame_of({{"jawOpen", 1.0F}}).viseme_blend, 50);
  EXPECT_EQ(frame_of({{"mouthPucker", 1.0F}}).viseme1, 14);
  EXPECT_GT(frame_of({{"mouthPucker", 1.0F}}).viseme_blend, 40);
  EXPECT_EQ(frame_of({{"mouthSmileLeft", 1.0F}, {"browInnerUp", 1.0F}}).viseme_blend, 0);
  int last = 63;
  for (int i = 0; i <= 200; ++i) {
    const semblante_frame frame = frame_of({{"jawOpen", 1.0F - 0.005F * i}, {"mouthPucker", 0.005F * i}});
    const int signed_blend = frame.viseme1 == 14 ? -frame.viseme_blend : frame.viseme_blend;
    EXPECT_LE(std::abs(signed_blend - last), 3) << i;
    last = signed_blend;
  }
  EXPECT_LT(last, -40);
}

TEST(FrameFromArkit, SmallChanges_MoveTheFaceALittle) {
  std::mt19937 random(3);
  for (int i = 0; i < 300; ++i) {
    const ArkitCoefficients c = any_face(random);
    ArkitCoefficients near = c;
    const std::size_t s = random() % arkit_count;
    near[s] = near[s] < 0.5F ? near[s] + 1e-3F : near[s] - 1e-3F;
    const semblante_frame a = frame_from_arkit(c)->frame;
    const semblante_frame b = frame_from_arkit(near)->frame;
    for (int n = 3; n <= SEMBLANTE_FAP_COUNT; ++n) {
      const bool turns = (n >= 23 && n <= 26) || (n >= 48 && n <= 50);
      // A FAP that is held against a viseme stands at one quantizer step.
      const float most =
          turns ? 70.0F : 4.0F + static_cast<float>(mpeg4::fap(static_cast<std::size_t>(n)).quantizer_step);
      EXPECT_LE(std::abs(a.fap[n] - b.fap[n]), most) << arkit_name(s) << " " << n;
    }
  }
}

}  // namespace
}  // namespace semblante
