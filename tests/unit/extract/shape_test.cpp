#include "core/extract/shape.h"

#include <gtest/gtest.h>

#include "tests/support/meshes.h"

namespace semblante {
namespace {

std::span<const std::uint8_t> bytes_of(std::string_view text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

Model square() {
  Model model = testing::make_model({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}});
  model.examples = {{"up", {1, 3}, {{0, 0, 2}, {0, 0, 4}}}, {"aside", {0}, {{-1, 0, 0}}}};
  return model;
}

TEST(ShapeOfTarget, IsTheNeutralOneWithTheTargetOn) {
  const auto up = shape_of_target(square(), "up");
  ASSERT_TRUE(up);
  EXPECT_EQ(*up, (std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 2}, {1, 1, 0}, {0, 1, 4}}));
  const auto neutral = shape_of_target(square(), "");
  ASSERT_TRUE(neutral);
  EXPECT_EQ(*neutral, square().positions);
}

TEST(ShapeOfTarget, ListsTheNamesThereAre) {
  const auto unknown = shape_of_target(square(), "down");
  ASSERT_FALSE(unknown);
  EXPECT_EQ(unknown.error().code, ErrorCode::missing);
  EXPECT_EQ(unknown.error().message, "the model has no morph target of this name; it has up, aside");
  const auto none = shape_of_target(testing::make_grid(1, 1), "down");
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().message, "the model has no morph target of this name; it has no morph targets");
}

TEST(ShapeOfFile, TakesVerticesAlone) {
  const std::string_view obj = "# a comment\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n";
  const auto shape = shape_of_file(square(), bytes_of(obj), "smile.obj");
  ASSERT_TRUE(shape) << shape.error().message;
  EXPECT_EQ((*shape)[2], glm::vec3(1, 1, 1));
  const std::string_view ply =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nend_header\n"
      "0 0 1\n1 0 1\n1 1 2\n0 1 1\n";
  const auto points = shape_of_file(square(), bytes_of(ply), "");
  ASSERT_TRUE(points) << points.error().message;
  EXPECT_EQ((*points)[2], glm::vec3(1, 1, 2));
}

TEST(ShapeOfFile, TakesTheSameMesh_ButNoOther) {
  EXPECT_TRUE(shape_of_file(square(), bytes_of("v 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\nf 1 2 3 4\n"), "a.obj"));
  const auto count = shape_of_file(square(), bytes_of("v 0 0 1\nv 1 0 1\nv 1 1 1\nf 1 2 3\n"), "a.obj");
  ASSERT_FALSE(count);
  EXPECT_EQ(count.error().code, ErrorCode::mismatch);
  EXPECT_EQ(count.error().where, "/expression");
  const auto empty = shape_of_file(square(), bytes_of("# nothing\nf\n"), "a.obj");
  ASSERT_FALSE(empty);
  EXPECT_EQ(empty.error().code, ErrorCode::empty);
  const auto unknown = shape_of_file(square(), bytes_of("what?"), "a.txt");
  ASSERT_FALSE(unknown);
  EXPECT_EQ(unknown.error().code, ErrorCode::unsupported);
  const auto not_finite = shape_of_file(square(), bytes_of("v 0 0 nan\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"), "a.obj");
  ASSERT_FALSE(not_finite);
  EXPECT_EQ(not_finite.error().code, ErrorCode::not_finite);
  EXPECT_EQ(not_finite.error().where, "line 1");
}

// What is not asked for positions alone still needs triangles.
TEST(ShapeOfFile, LeavesModelsAsStrictAsTheyWere) {
  const auto model = import_model(bytes_of("v 0 0 1\nv 1 0 1\nv 1 1 1\n"), ModelFormat::obj);
  ASSERT_FALSE(model);
  EXPECT_EQ(model.error().code, ErrorCode::empty);
}

}  // namespace
}  // namespace semblante
