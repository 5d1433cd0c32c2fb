// What coefficients do to whole heads: ours always, those of other makers where they are.

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "core/bridges/arkit.h"
#include "tests/support/closure.h"
#include "tests/support/fold_over.h"

namespace semblante {
namespace {

using bench::Opening;
using bench::OpeningKind;

semblante_frame frame_of(std::initializer_list<std::pair<const char*, float>> given) {
  ArkitCoefficients c{};
  for (const auto& [name, value] : given) c.at(find_arkit(name).value()) = value;
  return frame_from_arkit(c).value().frame;
}

class ArkitOnHeads : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    heads = new std::vector<bench::Head>(bench::known_heads());
    for (const bench::Head& head : *heads) faces.push_back(new bench::PosedFace(head, WeightMethod::smooth));
  }
  static void TearDownTestSuite() {
    for (const bench::PosedFace* face : faces) delete face;
    faces.clear();
    delete heads;
    heads = nullptr;
  }
  static inline std::vector<bench::Head>* heads = nullptr;
  static inline std::vector<const bench::PosedFace*> faces;
};

TEST_F(ArkitOnHeads, JawOpen_PartsTheLipsAndMouthCloseKeepsThemTogether) {
  std::size_t measured = 0;
  for (const bench::PosedFace* face : faces) {
    const std::string& name = face->head().name;
    if (name == "mediapipe-canonical") continue;  // its mouth is closed by triangles
    const auto mouth = Opening::find(*face, OpeningKind::mouth);
    if (!mouth) continue;
    ++measured;
    const double rest = mouth->measure(face->pose(semblante_frame{})).slit;
    const double open = mouth->measure(face->pose(frame_of({{"jawOpen", 1.0F}}))).slit;
    const double half = mouth->measure(face->pose(frame_of({{"jawOpen", 0.5F}}))).slit;
    const double shut = mouth->measure(face->pose(frame_of({{"jawOpen", 1.0F}, {"mouthClose", 1.0F}}))).slit;
    // Shares of MNS0, the way from nose to mouth.
    EXPECT_GT(open, rest + 0.5) << name;
    EXPECT_GT(half, rest + 0.25) << name;
    EXPECT_LT(half, open) << name;
    EXPECT_LT(shut, rest + 0.05) << name;
  }
  EXPECT_GE(measured, 1U);
}

TEST_F(ArkitOnHeads, EyeBlink_ClosesTheLids) {
  std::size_t measured = 0;
  for (const bench::PosedFace* face : faces) {
    for (const auto& [kind, blink, down] : {std::tuple(OpeningKind::left_eye, "eyeBlinkLeft", "eyeLookDownLeft"),
                                            std::tuple(OpeningKind::right_eye, "eyeBlinkRight", "eyeLookDownRight")}) {
      const auto eye = Opening::find(*face, kind);
      if (!eye) continue;
      ++measured;
      const double rest = eye->measure(face->pose(semblante_frame{})).slit;
      const double shut = eye->measure(face->pose(frame_of({{blink, 1.0F}}))).slit;
      const double shut_down = eye->measure(face->pose(frame_of({{blink, 1.0F}, {down, 1.0F}}))).slit;
      // Shares of IRISD0, how far the lids are apart at rest.
      EXPECT_GT(rest, 0.6) << face->head().name;
      // On a mask of 478 vertices a lid is six triangles.
      const double most = face->head().model.positions.size() < 1000 ? 0.35 : 0.25;
      EXPECT_LT(shut, most) << face->head().name << " " << blink;
      EXPECT_LT(shut_down, most) << face->head().name << " " << blink;
    }
  }
  EXPECT_GE(measured, 2U);
}

TEST_F(ArkitOnHeads, LeftShapes_LeaveTheRightSide) {
  const bench::PosedFace& face = *faces.front();
  const auto& rest = face.head().model.positions;
  float most_x = 0.0F;
  for (const glm::vec3& p : rest) most_x = std::max(most_x, std::abs(p.x));
  for (const char* const name : {"eyeBlinkLeft", "browDownLeft", "browOuterUpLeft", "cheekSquintLeft", "mouthSmileLeft",
                                 "mouthFrownLeft", "noseSneerLeft", "eyeSquintLeft", "eyeWideLeft"}) {
    const auto moved = face.pose(frame_of({{name, 1.0F}}));
    float left = 0.0F;
    float right = 0.0F;
    for (std::size_t v = 0; v < rest.size(); ++v) {
      const float way = glm::distance(moved[v], rest[v]);
      if (rest[v].x > 0.2F * most_x) left = std::max(left, way);
      if (rest[v].x < -0.2F * most_x) right = std::max(right, way);
    }
    EXPECT_GT(left, 0.0F) << name;
    EXPECT_LE(right, 0.2F * left) << name;
  }
}

// +X is the face's left: an eye that looks out on the left moves its front to +X.
TEST_F(ArkitOnHeads, EyesLook_WhereTheCoefficientsSay) {
  const bench::PosedFace& face = *faces.front();
  const auto& rest = face.head().model.positions;
  const auto front_of = [&](PartRole role) {
    std::uint32_t front = 0;
    float most = -1e9F;
    for (std::uint32_t v = 0; v < rest.size(); ++v) {
      if (face.role_of(v) == role && rest[v].z > most) most = rest[v].z, front = v;
    }
    return front;
  };
  const std::uint32_t left = front_of(PartRole::left_eye);
  const std::uint32_t right = front_of(PartRole::right_eye);
  const auto way = [&](const char* name, std::uint32_t v) { return face.pose(frame_of({{name, 1.0F}}))[v] - rest[v]; };
  EXPECT_GT(way("eyeLookOutLeft", left).x, 0.0F);
  EXPECT_LT(way("eyeLookInLeft", left).x, 0.0F);
  EXPECT_LT(way("eyeLookOutRight", right).x, 0.0F);
  EXPECT_GT(way("eyeLookInRight", right).x, 0.0F);
  EXPECT_GT(way("eyeLookUpLeft", left).y, 0.0F);
  EXPECT_LT(way("eyeLookDownRight", right).y, 0.0F);
}

// Faces stay faces: few triangles turn inside out, at the folds of lids and lips.
TEST_F(ArkitOnHeads, NoShape_TurnsTheSkinInsideOut) {
  for (const bench::PosedFace* face : faces) {
    const Model& model = face->head().model;
    for (std::size_t s = 0; s < arkit_count; ++s) {
      if (arkit_name(s).starts_with("eyeBlink")) continue;  // shut lids fold, as they should
      ArkitCoefficients c{};
      c[s] = 1.0F;
      const auto folds =
          bench::count_fold_over(model.triangles, model.positions, face->pose(frame_from_arkit(c).value().frame));
      EXPECT_LE(folds.inverted, model.triangles.size() / 250) << face->head().name << " " << arkit_name(s);
    }
  }
}

}  // namespace
}  // namespace semblante
