// The files of our own family, read back.
#include <algorithm>
#include <array>
#include <set>
#include <span>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/import/import.h"
#include "deploy/sample_head/write_sample_head.h"
#include "tests/support/sample_head_model.h"
#include "tests/support/sample_obj.h"
#include "tests/support/sample_shapes.h"

namespace semblante {
namespace {

class FamilyFiles : public ::testing::TestWithParam<testing::FamilyMember> {};

TEST_P(FamilyFiles, Counts_Positions_AndNames_AreThoseOfTheHead) {
  const Model made = testing::sample_head_model(GetParam().traits);
  const auto glb = sample_head_glb(make_sample_head(GetParam().traits));
  ASSERT_TRUE(glb);
  const auto model = import_model(*glb, ModelFormat::glb);
  ASSERT_TRUE(model) << model.error().where << ": " << model.error().message;
  EXPECT_EQ(model->positions, made.positions);
  EXPECT_EQ(model->triangles, made.triangles);
  ASSERT_EQ(model->primitives.size(), made.primitives.size());
  for (std::size_t i = 0; i < made.primitives.size(); ++i)
    EXPECT_EQ(model->primitives[i].name, made.primitives[i].name);
}

TEST_P(FamilyFiles, Triangles_OfGlbAndObj_AreAtTheSamePlaces) {
  const SampleHead head = make_sample_head(GetParam().traits);
  const auto glb = import_model(sample_head_glb(head).value(), ModelFormat::glb);
  const std::string text = testing::obj_of(head);
  const std::span bytes(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
  const auto obj = import_model(bytes, ModelFormat::obj);
  ASSERT_TRUE(glb);
  ASSERT_TRUE(obj) << obj.error().where << ": " << obj.error().message;
  const auto places = [](const Model& model) {
    std::multiset<std::array<float, 9>> all;
    for (const Triangle& t : model.triangles) {
      std::array<float, 9> place{};
      for (std::size_t c = 0; c < 3; ++c) {
        for (int axis = 0; axis < 3; ++axis)
          place[3 * c + static_cast<std::size_t>(axis)] = model.positions[t[c]][axis];
      }
      all.insert(place);
    }
    return all;
  };
  EXPECT_EQ(places(*glb), places(*obj));
}

INSTANTIATE_TEST_SUITE_P(Family, FamilyFiles, ::testing::ValuesIn(testing::sample_family()), testing::member_name);

TEST(AvatarFile, MorphTargets_OfAllMeshes_AreExamplesByName) {
  const SampleHead& avatar = testing::sample_avatar();
  const auto model = import_model(testing::sample_avatar_glb(), ModelFormat::glb);
  ASSERT_TRUE(model) << model.error().where << ": " << model.error().message;
  ASSERT_EQ(model->examples.size(), avatar.targets.size());
  for (const Example& example : model->examples) {
    const auto target = std::find_if(avatar.targets.begin(), avatar.targets.end(),
                                     [&](const SampleHeadTarget& t) { return t.name == example.name; });
    ASSERT_NE(target, avatar.targets.end()) << example.name;
    EXPECT_FALSE(example.vertices.empty()) << example.name;
    EXPECT_LT(example.vertices.size(), model->positions.size()) << example.name;
    for (std::uint32_t v = 0; v < model->positions.size(); ++v)
      ASSERT_EQ(example.at(v), target->displacements[v]) << example.name << ", vertex " << v;
  }
}

// The file is in its bind pose: the skeleton moves nothing.
TEST(AvatarFile, Skeleton_LeavesTheRestPose) {
  const auto model = import_model(testing::sample_avatar_glb(), ModelFormat::glb);
  ASSERT_TRUE(model);
  EXPECT_EQ(model->positions, testing::sample_head_model({.form = SampleHeadForm::body}).positions);
  ASSERT_TRUE(model->neck_joints.neck && model->neck_joints.head);
  EXPECT_EQ(model->neck_joints.neck->name, "Neck");
  EXPECT_LT(glm::distance(model->neck_joints.neck->position, glm::vec3(0.0F, -0.175F, -0.04F)), 1e-6F);
  EXPECT_EQ(model->neck_joints.head->name, "Head");
  EXPECT_LT(glm::distance(model->neck_joints.head->position, glm::vec3(0.0F, -0.09F, -0.025F)), 1e-6F);
  const SampleHead& avatar = testing::sample_avatar();
  for (const char* const name : {"Hips", "Spine", "Neck", "Head", "LeftArm", "RightHand", "LeftEye"}) {
    EXPECT_TRUE(std::any_of(avatar.joints.begin(), avatar.joints.end(), [&](const SampleHeadJoint& joint) {
      return joint.name == name;
    })) << name;
  }
  for (const SampleHeadMesh& mesh : avatar.meshes) {
    ASSERT_EQ(mesh.joint_weights.size(), mesh.positions.size()) << mesh.name;
    for (const glm::vec4& w : mesh.joint_weights) ASSERT_NEAR(w.x + w.y + w.z + w.w, 1.0F, 1e-6F) << mesh.name;
  }
}

}  // namespace
}  // namespace semblante
