#include <set>

#include <gtest/gtest.h>

#include "core/lod/decimate.h"
#include "core/lod/fixed_vertices.h"
#include "core/lod/level_error.h"
#include "core/lod/lod_poses.h"
#include "core/parametrize/parametrize.h"
#include "core/parametrize/place_feature_points.h"
#include "tests/oracle/real_heads.h"
#include "tests/support/sample_head_model.h"

namespace semblante {
namespace {

/// What must hold of every level of any head.
void check_levels(const Model& model, const FeaturePointSet& points, std::vector<std::uint32_t> budgets) {
  const Surface surface = build_surface(model);
  const auto rig = parametrize(model, surface, points);
  ASSERT_TRUE(rig.ok());
  const std::vector<LodPose> poses = lod_poses(*rig, model);
  LodOptions options;
  options.budgets = budgets;
  options.poses = poses;
  const auto levels = decimate(model, surface, *rig, options);
  ASSERT_TRUE(levels.ok());
  ASSERT_EQ(levels->size(), budgets.size());
  const std::vector<bool> fixed = fixed_vertices(surface, model, rig->points, rig->influence);
  const double es = 1024.0 * rig->fapu[FapuUnit::es].value_or(0.0);
  for (std::size_t i = 0; i < levels->size(); ++i) {
    const LevelOfDetail& level = (*levels)[i];
    SCOPED_TRACE(level.budget);
    EXPECT_LE(level.vertex_count, level.budget);
    std::set<std::uint32_t> used;
    for (const Triangle& t : level.triangles) {
      for (const std::uint32_t v : t) used.insert(surface.surface_of[v].value());
    }
    for (std::uint32_t s = 0; s < fixed.size(); ++s) {
      if (fixed[s] && !surface.steps_from(SurfaceVertexId(s)).empty()) {
        EXPECT_TRUE(used.contains(s)) << "surface vertex " << s;
      }
    }
    const LevelError error = measure_level(model, surface, level, poses);
    EXPECT_EQ(error.flipped_triangles, 0U);
    EXPECT_EQ(error.flipped_uvs, 0U);
    EXPECT_LT(error.neutral.rms, 0.03 * es);
    for (const SurfaceError& pose : error.poses) EXPECT_LT(pose.rms, 1.25 * error.neutral.rms + 0.002 * es);
  }
}

void check_levels(const Model& model, const std::vector<MarkedPoint>& marked, std::vector<std::uint32_t> budgets) {
  const auto points = place_feature_points(model, build_surface(model), marked, nullptr);
  ASSERT_TRUE(points.ok());
  check_levels(model, *points, std::move(budgets));
}

class FamilyLevels : public ::testing::TestWithParam<testing::FamilyMember> {};

TEST_P(FamilyLevels, GoToTheirBudgets) {
  const SampleHeadTraits& traits = GetParam().traits;
  // A body needs vertices for its clothes and hands too.
  const std::uint32_t fewest = traits.form == SampleHeadForm::body ? 4000 : 3000;
  check_levels(testing::sample_head_model(traits), testing::sample_head_points(traits), {6000, fewest});
}

INSTANTIATE_TEST_SUITE_P(Lod, FamilyLevels, ::testing::ValuesIn(testing::sample_family()), testing::member_name);

TEST(RealHeadLevels, TheSmallerHeadGoesToItsBudgets) {
  const auto folder = oracle::faces_folder();
  if (!folder) GTEST_SKIP() << "no folder of real heads";
  check_levels(oracle::import_head(*folder / "makehuman/head.glb"),
               oracle::read_trusted_points(*folder / "makehuman/makehuman.fps.json"), {2500, 1500});
}

TEST(RealHeadLevels, TheLargerHeadGoesDownTheLadder) {
  const auto folder = oracle::faces_folder();
  if (!folder) GTEST_SKIP() << "no folder of real heads";
  check_levels(oracle::import_head(*folder / "ict-facekit/neutral.obj"),
               oracle::read_trusted_points(*folder / "ict-facekit/ict-facekit.fps.json"), {20000, 10000, 5000, 2500});
}

}  // namespace
}  // namespace semblante
