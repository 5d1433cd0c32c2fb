// The joints of neck and head of a file's skins.
#include "core/import/gltf_neck_joints.h"

#include <gtest/gtest.h>

#include "core/import/axes.h"
#include "tests/unit/import/gltf_writer.h"

namespace semblante::test {
namespace {

using Json = nlohmann::json;
using import::joint_kind;
using import::JointKind;

TEST(JointKind, IsSaidByTheLastWord) {
  for (const char* const name : {"Neck", "neck_01", "mixamorig:Neck", "mixamorigNeck", "CC_Base_NeckTwist01",
                                 "J_Bip_C_Neck", "Bip001 Neck", "DEF-neck.001", "NECK"})
    EXPECT_EQ(joint_kind(name), JointKind::neck) << name;
  for (const char* const name : {"Head", "head", "mixamorig:Head", "CC_Base_Head", "J_Bip_C_Head", "Bip001_Head"})
    EXPECT_EQ(joint_kind(name), JointKind::head) << name;
  for (const char* const name : {"HeadTop_End", "head_nub", "headfront", "Neck_L", "Necklace", "Forehead", "twist",
                                 "Twist01", "", "_", "Hips", "\xff\xfe"})
    EXPECT_EQ(joint_kind(name), JointKind::other) << name;
}

/// A quad bound to a chain of joints, one above the other by 1 from y = 1 on. Node 0 has the mesh, node 1 is the first
/// joint.
GltfWriter skeleton(const std::vector<std::string>& names) {
  GltfWriter writer;
  writer.add_quad();
  writer.primitive()["attributes"]["JOINTS_0"] =
      writer.accessor(writer.view(bytes_of(std::vector<std::uint8_t>(16, 0))), u8, 4, "VEC4");
  writer.primitive()["attributes"]["WEIGHTS_0"] =
      writer.floats({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4");
  writer.json["scenes"][0]["nodes"] = {0, 1};
  writer.json["nodes"][0]["skin"] = 0;
  Json joints = Json::array();
  std::vector<float> inverse_bind;
  for (std::size_t i = 0; i < names.size(); ++i) {
    Json node = {{"name", names[i]}, {"translation", {0, 1, 0}}};
    if (i + 1 < names.size()) node["children"] = {i + 2};
    writer.json["nodes"].push_back(node);
    joints.push_back(i + 1);
    for (int k = 0; k < 16; ++k)
      inverse_bind.push_back(k % 5 == 0 ? 1.0F : k == 13 ? -static_cast<float>(i + 1) : 0.0F);
  }
  writer.json["skins"] = {{{"joints", joints}}};
  writer.json["skins"][0]["inverseBindMatrices"] =
      writer.accessor(writer.view(bytes_of(inverse_bind)), f32, names.size(), "MAT4");
  return writer;
}

NeckJoints joints_of(const GltfWriter& writer) {
  const auto model = writer.import();
  EXPECT_TRUE(model) << model.error().where << " " << model.error().message;
  return model ? model->neck_joints : NeckJoints{};
}

TEST(NeckJointsOfAFile, AreFoundByName_AtTheirPlacesAtRest) {
  const NeckJoints joints = joints_of(skeleton({"Hips", "neck_01", "neck_02", "Head", "HeadTop_End"}));
  ASSERT_TRUE(joints.neck && joints.head);
  EXPECT_EQ(joints.neck->name, "neck_01") << "the lowest";
  EXPECT_EQ(joints.neck->position, glm::vec3(0, 2, 0));
  EXPECT_EQ(joints.head->name, "Head");
  EXPECT_EQ(joints.head->position, glm::vec3(0, 4, 0));
}

TEST(NeckJointsOfAFile, TurnWithTheAxes) {
  auto model = skeleton({"Neck", "Head"}).import();
  ASSERT_TRUE(model);
  change_axes(*model, glm::dmat3(1, 0, 0, 0, -1, 0, 0, 0, -1));
  EXPECT_EQ(model->neck_joints.neck->position, glm::vec3(0, -1, 0));
  EXPECT_EQ(model->neck_joints.head->position, glm::vec3(0, -2, 0));
}

TEST(NeckJointsOfAFile, AreThoseThatVrmNames) {
  GltfWriter writer = skeleton({"Head", "a", "b", "Neck"});
  writer.json["extensions"]["VRM"]["humanoid"]["humanBones"] = {
      {{"bone", "hips"}, {"node", 1}}, {{"bone", "neck"}, {"node", 2}}, {{"bone", "head"}, {"node", 3}}};
  EXPECT_EQ(joints_of(writer).neck->name, "a");
  EXPECT_EQ(joints_of(writer).head->name, "b");
  writer.json["extensions"] = {
      {"VRMC_vrm", {{"humanoid", {{"humanBones", {{"neck", {{"node", 3}}}, {"head", {{"node", 4}}}}}}}}}};
  EXPECT_EQ(joints_of(writer).neck->name, "b");
  EXPECT_EQ(joints_of(writer).head->name, "Neck");
}

TEST(NeckJointsOfAFile, WithoutASkeleton_AreNone) {
  GltfWriter writer;
  writer.add_quad();
  writer.json["nodes"][0]["name"] = "Head";
  EXPECT_FALSE(joints_of(writer).neck || joints_of(writer).head) << "a node that no skin uses";
}

// A humanoid that is wrong does no harm: the names count, or nothing.
TEST(NeckJointsOfAFile, AWrongHumanoid_IsNoFaultOfTheFile) {
  const Json wrong[] = {Json(),
                        Json(7),
                        Json::array(),
                        Json::object(),
                        Json{{"humanBones", "none"}},
                        Json{{"humanBones", {1, 2}}},
                        Json{{"humanBones", {{{"bone", 3}, {"node", 2}}}}},
                        Json{{"humanBones", {{{"bone", "neck"}, {"node", -1}}}}},
                        Json{{"humanBones", {{{"bone", "neck"}, {"node", 1e300}}}}},
                        Json{{"humanBones", {{"neck", {{"node", 99}}}, {"head", "x"}}}}};
  for (const char* const extension : {"VRM", "VRMC_vrm"}) {
    for (const Json& humanoid : wrong) {
      GltfWriter writer = skeleton({"Neck", "Head"});
      writer.json["extensions"][extension]["humanoid"] = humanoid;
      const NeckJoints joints = joints_of(writer);
      ASSERT_TRUE(joints.neck && joints.head) << humanoid;
      EXPECT_EQ(joints.head->name, "Head");
    }
  }
}

TEST(NeckJointsOfAFile, OutsideTheSceneOrFarFromAllNumbers_AreLeftOut) {
  GltfWriter outside = skeleton({"Neck", "Head"});
  outside.json["scenes"][0]["nodes"] = {0};
  EXPECT_FALSE(joints_of(outside).neck || joints_of(outside).head);

  GltfWriter far = skeleton({"Neck", "Head"});
  far.json["nodes"][0].erase("skin");
  far.json["nodes"][2]["translation"] = {0, 1e39, 0};
  EXPECT_TRUE(joints_of(far).neck);
  EXPECT_FALSE(joints_of(far).head);
}

TEST(NeckJointsOfAFile, OfASkinThatNoMeshUses_MayBeWrong) {
  GltfWriter writer = skeleton({"Neck", "Head"});
  writer.json["skins"].push_back({{"joints", {77, -1, "x"}}});
  EXPECT_TRUE(joints_of(writer).neck && joints_of(writer).head);
}

}  // namespace
}  // namespace semblante::test
