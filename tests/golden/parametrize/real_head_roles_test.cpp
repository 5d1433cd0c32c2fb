// Guessed roles on heads made by others, held to what their makers say about them.

#include <algorithm>
#include <ostream>
#include <string>

#include <gtest/gtest.h>

#include "core/anatomy/part_roles.h"
#include "core/geometry/surface.h"
#include "core/parametrize/parametrize.h"
#include "core/parametrize/place_feature_points.h"
#include "tests/oracle/real_heads.h"

namespace semblante {
namespace {

/// What may speak for a part's role.
struct Hints {
  const char* name;
  bool points;
  bool names;
};
void PrintTo(const Hints& hints, std::ostream* out) { *out << hints.name; }

class RealHeadRoles : public ::testing::TestWithParam<Hints> {
 protected:
  void load(const char* folder_name, const char* model_file, const char* points_file) {
    const auto folder = oracle::faces_folder();
    if (!folder) GTEST_SKIP() << "no folder of real heads";
    model_ = oracle::import_head(*folder / folder_name / model_file);
    surface_ = build_surface(model_);
    auto placed = place_feature_points(model_, surface_,
                                       oracle::read_trusted_points(*folder / folder_name / points_file), nullptr);
    ASSERT_TRUE(placed) << placed.error().message;
    points_ = *std::move(placed);
    if (!GetParam().names) {
      for (Primitive& primitive : model_.primitives)
        primitive = {"", -1, primitive.first_triangle, primitive.triangle_count};
    }
    parts_ = describe_parts(model_, surface_, GetParam().points ? points_ : FeaturePointSet{});
  }

  [[nodiscard]] PartRole role_of(std::uint32_t vertex) const {
    return parts_[surface_.part_of[surface_.surface_of[vertex].value()].value()].role;
  }

  void expect_role(std::uint32_t first, std::uint32_t last, PartRole role) const {
    for (std::uint32_t v = first; v <= last; ++v) {
      ASSERT_EQ(role_of(v), role) << "vertex " << v << " is " << part_role_names[static_cast<std::size_t>(role_of(v))]
                                  << ", not " << part_role_names[static_cast<std::size_t>(role)];
    }
  }

  Model model_;
  Surface surface_;
  FeaturePointSet points_;
  std::vector<Part> parts_;
};

TEST_P(RealHeadRoles, IctFaceKit) {
  ASSERT_NO_FATAL_FAILURE(load("ict-facekit", "neutral.obj", "ict-facekit.fps.json"));
  if (IsSkipped()) return;
  // Index ranges as the model documents them.
  expect_role(0, 14061, PartRole::skin);
  // Gums and tongue are one part: a tongue by its points or its name, some part of the mouth otherwise.
  const PartRole gums = role_of(14062);
  EXPECT_TRUE(gums == PartRole::tongue || gums == PartRole::upper_teeth || gums == PartRole::lower_teeth);
  if (GetParam().points || GetParam().names) {
    EXPECT_EQ(gums, PartRole::tongue);
  }
  expect_role(17039, 19246, PartRole::upper_teeth);
  expect_role(19247, 21450, PartRole::lower_teeth);
  expect_role(21451, 23020, PartRole::left_eye);
  expect_role(23021, 24590, PartRole::right_eye);
  expect_role(24591, 26718, PartRole::attached);
}

TEST_P(RealHeadRoles, MakeHuman) {
  ASSERT_NO_FATAL_FAILURE(load("makehuman", "head.obj", "makehuman.fps.json"));
  if (IsSkipped()) return;
  // The groups of the file, in its order.
  expect_role(0, 4303, PartRole::skin);
  expect_role(4304, 4529, PartRole::tongue);
  expect_role(4530, 4601, PartRole::left_eye);
  expect_role(4602, 4673, PartRole::right_eye);
  expect_role(4674, 4923, PartRole::attached);
  expect_role(4924, 4991, PartRole::lower_teeth);
  expect_role(4992, 5059, PartRole::upper_teeth);
}

INSTANTIATE_TEST_SUITE_P(Hints, RealHeadRoles,
                         ::testing::Values(Hints{"PointsAndNames", true, true}, Hints{"PointsAlone", true, false},
                                           Hints{"NamesAlone", false, true}, Hints{"PlaceAlone", false, false}),
                         [](const auto& info) { return info.param.name; });

TEST(RealHeadRig, IctGums_StayWithTheTeethThatStandInThem) {
  const auto folder = oracle::faces_folder();
  if (!folder) GTEST_SKIP() << "no folder of real heads";
  const Model model = oracle::import_head(*folder / "ict-facekit/neutral.obj");
  const Surface surface = build_surface(model);
  const auto points = place_feature_points(
      model, surface, oracle::read_trusted_points(*folder / "ict-facekit/ict-facekit.fps.json"), nullptr);
  ASSERT_TRUE(points);
  const auto rig = parametrize(model, surface, *points);
  ASSERT_TRUE(rig);
  const auto jaw_share = [&](std::uint32_t vertex) {
    const auto ids = rig->influence.points_of(vertex);
    return ids.empty() || ids[0] != parse_feature_point("2.1") ? 0.0F : rig->influence.weights_of(vertex)[0];
  };
  // Gum vertices in front of the upper incisors (above y = -1.5) and of the lower ones (below y = -5).
  int upper = 0;
  int lower = 0;
  for (std::uint32_t v = 14062; v <= 17038; ++v) {
    const glm::vec3& p = model.positions[v];
    if (p.z < 9.0F) continue;
    if (p.y > -1.5F) {
      ++upper;
      EXPECT_EQ(jaw_share(v), 0.0F) << "vertex " << v;
    } else if (p.y < -5.0F) {
      ++lower;
      EXPECT_EQ(jaw_share(v), 1.0F) << "vertex " << v;
    }
  }
  EXPECT_GT(upper, 20);
  EXPECT_GT(lower, 20);
}

}  // namespace
}  // namespace semblante
