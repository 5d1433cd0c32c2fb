// Without points: what the parts show. Better no answer than a wrong one.
#include <gtest/gtest.h>

#include "core/geometry/surface.h"
#include "tests/unit/frame/turned_heads.h"

namespace semblante::test {
namespace {

struct Count {
  int right = 0;  ///< sure, and so
  int wrong = 0;  ///< sure, and not so
  int unsure = 0;
};

/// As an OBJ would hold them: glTF has a rule of its own. Large heads, whose answers cost most, in every fourth of the
/// 24 positions, which are all six for up.
Count recovered(const Model& upright) {
  Count count;
  const auto all = all_axes();
  for (std::size_t i = 0; i<all.size(); i += upright.positions.size()> 10'000 ? 4 : 1) {
    Model model = turned(upright, all[i]);
    model.format = "obj";
    const ModelFrame guess = guess_frame(model, build_surface(model));
    ++(!guess.axes_sure ? count.unsure : guess.axes == all[i] ? count.right : count.wrong);
  }
  return count;
}

void forget_names(Model& model) {
  for (Primitive& primitive : model.primitives) {
    primitive.name.clear();
    primitive.material = -1;
  }
}

TEST(FrameFromShape, HeadsWithNamedParts_AreRecovered_InAll24Positions) {
  for (const Head& head : upright_heads()) {
    const Count count = recovered(head.model);
    EXPECT_EQ(count.wrong, 0) << head.name;
    // A mask with two irises has neither eyeballs nor a neck.
    EXPECT_EQ(head.name == "mediapipe" ? count.right : count.unsure, 0) << head.name;
  }
}

TEST(FrameFromShape, HeadsWithoutNames_AreNeverTurnedWrongly) {
  for (Head& head : upright_heads()) {
    forget_names(head.model);
    const Count count = recovered(head.model);
    EXPECT_EQ(count.wrong, 0) << head.name;
    // The eyeballs of ICT are a sclera and an iris each; there and on the mask nothing is sure.
    const bool shows_enough = head.name == "sample" || head.name.starts_with("makehuman");
    EXPECT_EQ(shows_enough ? count.unsure : count.right, 0) << head.name;
  }
}

TEST(FrameFromShape, Units_OfTheHeads) {
  for (Head& head : upright_heads()) {
    const ModelFrame guess = guess_frame(head.model, build_surface(head.model));
    const std::string expected = head.name == "sample" ? "m" : head.name.starts_with("makehuman") ? "dm" : "cm";
    EXPECT_EQ(to_string(guess.unit), expected) << head.name;
    EXPECT_FALSE(guess.reasons.empty()) << head.name;
  }
}

TEST(FrameFromShape, ACube_IsTakenAsItLies) {
  Model cube;
  for (int i = 0; i < 8; ++i) cube.positions.emplace_back(i & 1, i >> 1 & 1, i >> 2);
  cube.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4}, {2, 6, 3}, {3, 6, 7}};
  cube.format = "obj";
  const ModelFrame guess = guess_frame(cube, build_surface(cube));
  EXPECT_FALSE(guess.axes_sure);
  EXPECT_EQ(guess.axes, Axes{});
  cube.format = "glb";
  EXPECT_TRUE(guess_frame(cube, build_surface(cube)).axes_sure) << "glTF has a rule";
}

}  // namespace
}  // namespace semblante::test
