// Without points: what the parts show. Better no answer than a wrong one.
#include <algorithm>

#include <gtest/gtest.h>

#include "core/geometry/surface.h"
#include "tests/support/meshes.h"
#include "tests/unit/frame/turned_heads.h"

namespace semblante::test {
namespace {

struct Count {
  int right = 0;  ///< sure, and so
  int wrong = 0;  ///< sure, and not so
  int unsure = 0;
};

constexpr std::size_t all_ups = 4;  ///< every fourth of the 24 positions: all six for up
constexpr std::size_t few = 8;      ///< where a face is looked for in each of them, and none is there

/// As an OBJ would hold them: glTF has a rule of its own. In every `nth` of the 24 positions.
Count recovered(const Model& upright, std::size_t nth) {
  Count count;
  const auto all = all_axes();
  for (std::size_t i = 0; i < all.size(); i += nth) {
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

TEST(FrameFromShape, HeadsWithNamedParts_AreRecovered_InAllPositionsOfTheTop) {
  for (const Head& head : upright_heads()) {
    const Count count = recovered(head.model, all_ups);
    EXPECT_EQ(count.wrong, 0) << head.name;
    EXPECT_EQ(count.unsure, 0) << head.name;
  }
}

TEST(FrameFromShape, HeadsWithoutNames_AreRecovered_InAllPositionsOfTheTop) {
  for (Head& head : upright_heads()) {
    forget_names(head.model);
    const Count count = recovered(head.model, all_ups);
    EXPECT_EQ(count.wrong, 0) << head.name;
    // ICT's eyeballs are a sclera and an iris each, and the mask has none: their faces are seen.
    EXPECT_EQ(count.unsure, 0) << head.name;
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

TEST(FrameFromShape, ABustGuessedInInches_IsNotSure_WithEyesOrWithout) {
  for (const bool has_eyes : {true, false}) {
    Model bust = upright_heads().front().model;
    bust.format = "obj";
    for (glm::vec3& position : bust.positions) position /= static_cast<float>(metres_per(LengthUnit::inch));
    if (!has_eyes) {
      // Only the skin is left: its height is all there is to tell the unit.
      const auto skin =
          std::max_element(bust.primitives.begin(), bust.primitives.end(),
                           [](const auto& a, const auto& b) { return a.triangle_count < b.triangle_count; });
      const auto first = bust.triangles.begin() + skin->first_triangle;
      bust.triangles = std::vector<Triangle>(first, first + skin->triangle_count);
      bust.uv_triangles.clear();
      bust.normal_triangles.clear();
      bust.primitives = {*skin};
      bust.primitives[0].first_triangle = 0;
    }
    const ModelFrame guess = guess_frame(bust, build_surface(bust));
    EXPECT_EQ(guess.unit, LengthUnit::inch) << has_eyes;
    EXPECT_FALSE(guess.unit_sure) << has_eyes;
  }
}

TEST(FrameFromShape, TheMetreOfAGltf_IsSure_IfAHeadOrABodyHasThatHeight) {
  const auto guess_of = [](float height) {
    Model box = testing::make_box(glm::vec3(0.0F), glm::vec3(0.5F * height, height, 0.5F * height));
    box.format = "glb";
    return guess_frame(box, build_surface(box));
  };
  for (const float height : {0.25F, 0.6F, 1.3F, 1.8F}) {
    EXPECT_EQ(guess_of(height).unit, LengthUnit::metre) << height;
    EXPECT_TRUE(guess_of(height).unit_sure) << height;
  }
  for (const float height : {0.12F, 0.9F, 2.5F}) {
    EXPECT_EQ(guess_of(height).unit, LengthUnit::metre) << height;
    EXPECT_FALSE(guess_of(height).unit_sure) << height;
  }
}

/// A skull with a nose and two eyeballs in MPEG-4's axes, without the triangles above `cut` and below `bottom`.
Model skull(float cut, float bottom, bool has_eyes) {
  Model model = testing::make_ball({0.0F, 0.0F, 0.0F}, 10.0F, 32, 16);
  for (glm::vec3& p : model.positions)
    if (p.z > 9.0F) p.z += 1.5F;
  std::erase_if(model.triangles, [&](const Triangle& triangle) {
    return std::any_of(triangle.begin(), triangle.end(),
                       [&](std::uint32_t v) { return model.positions[v].y > cut || model.positions[v].y < bottom; });
  });
  model.primitives[0].triangle_count = static_cast<std::uint32_t>(model.triangles.size());
  if (has_eyes)
    for (const float side : {-1.0F, 1.0F})
      testing::append(model, testing::make_ball({3.2F * side, 4.0F, 8.0F}, 1.2F), "ball");
  return model;
}

TEST(FrameFromShape, AHeadThatIsOpenUnderItsHat_IsNotTurnedOver) {
  for (const bool is_open_below : {false, true}) {
    for (const bool has_eyes : {true, false}) {
      if (!is_open_below && !has_eyes) continue;  // nothing says that the opening is no neck
      const Count count = recovered(skull(6.0F, is_open_below ? -6.0F : -20.0F, has_eyes), few);
      EXPECT_EQ(count.wrong, 0) << is_open_below << has_eyes;
      EXPECT_GT(count.unsure, 0) << is_open_below << has_eyes;
    }
  }
  EXPECT_EQ(recovered(skull(20.0F, -6.0F, true), 1).right, 24) << "the same with a neck";
}

TEST(FrameFromShape, AxesThatTheShapeRulesOut_AreNotAssumed) {
  const auto guess_of = [](const Axes& axes) {
    Model model = turned(skull(20.0F, -20.0F, true), axes);
    model.format = "obj";
    return guess_frame(model, build_surface(model));
  };
  // Across Y nobody stands along Y; the eyes show the front.
  const Axes of_games{Direction::plus_z, Direction::plus_x}, sideways{Direction::plus_y, Direction::minus_x};
  for (const Axes& axes : {Axes{}, of_games, sideways}) {
    const ModelFrame guess = guess_of(axes);
    EXPECT_FALSE(guess.axes_sure);
    EXPECT_EQ(guess.axes, axes) << guess.reasons.back();
  }
}

// A game's character exported as it stands there; the rule of glTF would have it look to a side.
TEST(FrameFromShape, AGltfThatLooksToASide_IsNotSure) {
  const auto guess_of = [](const Axes& axes) {
    Model model = turned(skull(20.0F, -20.0F, true), axes);
    model.format = "glb";
    return guess_frame(model, build_surface(model));
  };
  EXPECT_TRUE(guess_of({}).axes_sure);
  const Axes of_games{Direction::plus_z, Direction::plus_x}, sideways{Direction::plus_y, Direction::minus_x};
  for (const Axes& axes : {of_games, sideways}) {
    const ModelFrame guess = guess_of(axes);
    EXPECT_FALSE(guess.axes_sure);
    EXPECT_EQ(guess.axes, axes) << guess.reasons.back();
  }
}

// Exported with Z up although glTF says Y.
TEST(FrameFromShape, AGltfThatWouldLieOnItsFace_IsNotSure_AndItsTopIsAssumed) {
  const Axes of_blender{Direction::plus_z, Direction::minus_y};
  const auto guess_of = [](Model model, const Axes& axes, std::string_view format) {
    model = turned(model, axes);
    model.format = format;
    return guess_frame(model, build_surface(model));
  };
  for (const std::string_view format : {"glb", "obj"}) {
    const ModelFrame head = guess_of(skull(20.0F, -20.0F, true), of_blender, format);
    EXPECT_FALSE(head.axes_sure) << format;
    EXPECT_EQ(head.axes, of_blender) << format;
    // Higher than wide, without eyes and open nowhere; the second is no body's size.
    const Model body = testing::make_box(glm::vec3(-0.3F, 0.0F, -0.15F), glm::vec3(0.3F, 1.7F, 0.15F));
    EXPECT_FALSE(guess_of(body, of_blender, format).axes_sure) << format;
    EXPECT_EQ(guess_of(body, of_blender, format).axes, of_blender) << format;
    EXPECT_EQ(guess_of(body, {}, format).axes, Axes{}) << format;
    const Model fish = testing::make_box(glm::vec3(-0.3F, 0.0F, -4.0F), glm::vec3(0.3F, 1.0F, 4.0F));
    EXPECT_FALSE(guess_of(fish, {}, format).axes_sure) << format;
    EXPECT_EQ(guess_of(fish, {}, format).axes, Axes{}) << format;
  }
  EXPECT_TRUE(guess_of(skull(20.0F, -20.0F, true), {}, "glb").axes_sure);
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

TEST(FrameFromShape, BallsThatNothingShowsToBeEyes_LeaveTheUnitUnsure) {
  Model model = skull(20.0F, -20.0F, true);
  const ModelFrame balls = guess_frame(model, build_surface(model));
  EXPECT_FALSE(balls.axes_sure);
  EXPECT_EQ(balls.unit, LengthUnit::centimetre);
  EXPECT_FALSE(balls.unit_sure);
  for (Primitive& primitive : model.primitives)
    if (primitive.name == "ball") primitive.name = "eye";
  EXPECT_TRUE(guess_frame(model, build_surface(model)).unit_sure) << "by their names they are";
}

}  // namespace
}  // namespace semblante::test
