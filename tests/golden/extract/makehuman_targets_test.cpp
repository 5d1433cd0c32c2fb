// The morph targets of a real GLB: what they move, read off as sets.
#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/extract/extract.h"
#include "core/extract/shape.h"
#include "core/parametrize/parametrize.h"
#include "core/parametrize/place_feature_points.h"
#include "tests/golden/extract/worn_set.h"
#include "tests/oracle/real_heads.h"

namespace semblante {
namespace {

struct MakehumanTargets : ::testing::Test {
  std::optional<std::filesystem::path> faces = oracle::faces_folder();
  testing::RealHead head;
  void SetUp() override {
    if (!faces) GTEST_SKIP() << "no folder of real heads";
    // The points are numbered for head.obj; in the GLB their positions say where they are.
    head.model = oracle::import_head(*faces / "makehuman" / "head.glb");
    head.surface = build_surface(head.model);
    auto marked = oracle::read_trusted_points(*faces / "makehuman" / "makehuman.fps.json");
    for (MarkedPoint& point : marked) {
      if (point.position) point.vertex.reset();
    }
    const auto placed = place_feature_points(head.model, head.surface, marked, nullptr);
    ASSERT_TRUE(placed) << placed.error().message;
    auto rig = parametrize(head.model, head.surface, *placed);
    ASSERT_TRUE(rig);
    head.rig = std::move(*rig);
  }
  [[nodiscard]] std::array<float, feature_point_count * 3> set_of(const std::string& target) const {
    const auto shape = shape_of_target(head.model, target);
    EXPECT_TRUE(shape) << target;
    if (!shape) return {};
    const auto extraction = extract_displacements(head.rig.points, head.rig.fapu, head.model.positions, *shape);
    EXPECT_TRUE(extraction) << target << ": " << extraction.error().message;
    if (!extraction) return {};
    EXPECT_TRUE(extraction->skipped.empty()) << target;
    return to_dense(extraction->displacements);
  }
};

float along(const std::array<float, feature_point_count * 3>& set, std::string_view point, int axis) {
  return set[parse_feature_point(point)->value() * 3 + static_cast<std::size_t>(axis)];
}

TEST_F(MakehumanTargets, EachGivesASetThatMovesTheHeadAsTheTargetDoes) {
  ASSERT_EQ(head.model.examples.size(), 19U);
  for (const Example& example : head.model.examples) {
    const auto shape = shape_of_target(head.model, example.name);
    ASSERT_TRUE(shape);
    const auto extraction = extract_displacements(head.rig.points, head.rig.fapu, head.model.positions, *shape);
    // A target of tongue or eyeballs alone moves no marked point.
    if (!extraction) {
      EXPECT_EQ(extraction.error().code, ErrorCode::empty) << example.name << ": " << extraction.error().message;
      continue;
    }
    const NamedSet set{example.name, SetKind::expression, extraction->displacements};
    const auto in_units = to_model_units(set.view(), head.rig.fapu);
    EXPECT_TRUE(in_units.skipped.empty());
    for (const Displacement& d : in_units.displacements) {
      const auto point = std::find_if(head.rig.points.begin(), head.rig.points.end(),
                                      [&](const FeaturePoint& p) { return p.id == d.point; });
      const glm::vec3 expected = example.at(point->vertex->value());
      EXPECT_LT(glm::distance(d.value, expected), 1e-6F) << example.name << " " << to_string(d.point);
    }
  }
}

TEST_F(MakehumanTargets, SaysWhichSideCloses) {
  const auto closed = set_of("eyeClosedLeft");
  EXPECT_LT(along(closed, "3.1", 1), -300.0F);  // upper lid, of 1024 to the lower one
  EXPECT_NEAR(along(closed, "3.2", 1), 0.0F, 1.0F);
  const auto raised = set_of("browUpLeft");
  EXPECT_GT(along(raised, "4.3", 1), 20.0F);
  EXPECT_NEAR(along(raised, "4.4", 1), 0.0F, 1.0F);
}

}  // namespace
}  // namespace semblante
