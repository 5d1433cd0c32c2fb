#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "clients/runtime/semblante.h"
#include "tests/unit/runtime/owned.h"
#include "tests/unit/runtime/sdk_from_c.h"
#include "tests/unit/runtime/small_package.h"

namespace semblante::testing {
namespace {

/// Of a weight, by 16 bits, times the greatest displacement in these tests.
constexpr float quantization = 2e-5F;

OwnedHead make(const SmallPackage& small, const semblante_head_options* options = nullptr) {
  const semblante_package package = small.view();
  semblante_head* head = nullptr;
  semblante_error error{};
  EXPECT_EQ(semblante_head_create(&package, options, &head, &error), SEMBLANTE_OK) << error.where << error.message;
  return OwnedHead(head);
}

std::array<float, 12> positions_of(const semblante_head* head) {
  std::array<float, 12> positions{};
  EXPECT_EQ(semblante_head_positions(head, positions.data(), positions.size()), SEMBLANTE_OK);
  return positions;
}

semblante_result create_result(const semblante_package& package, semblante_error* error) {
  semblante_head* head = nullptr;
  const semblante_result result = semblante_head_create(&package, nullptr, &head, error);
  EXPECT_EQ(head == nullptr, result != SEMBLANTE_OK);
  semblante_head_destroy(head);
  return result;
}

TEST(HeadCreate, InvalidInputs_EachIsNamed) {
  SmallPackage small;
  semblante_error error{};
  {  // Nothing at all.
    EXPECT_EQ(create_result(semblante_package{}, &error), SEMBLANTE_INVALID_ARGUMENT);
    EXPECT_STREQ(error.where, "package");
  }
  {  // A null package, and nowhere to put a head.
    semblante_head* head = nullptr;
    EXPECT_EQ(semblante_head_create(nullptr, nullptr, &head, nullptr), SEMBLANTE_INVALID_ARGUMENT);
    const semblante_package package = small.view();
    EXPECT_EQ(semblante_head_create(&package, nullptr, nullptr, &error), SEMBLANTE_INVALID_ARGUMENT);
  }
  {  // A position that is no number.
    SmallPackage bad;
    bad.positions[4] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(create_result(bad.view(), &error), SEMBLANTE_INVALID_ARGUMENT);
    EXPECT_STREQ(error.where, "package.positions");
  }
  {  // The place is that of the file and of its part.
    semblante_package package = small.view();
    package.weights_size = 10;
    EXPECT_EQ(create_result(package, &error), SEMBLANTE_MALFORMED);
    EXPECT_STREQ(error.where, "weights/header");
  }
  {  // Too few positions for the table.
    semblante_package package = small.view();
    package.vertex_count = 3;
    EXPECT_EQ(create_result(package, &error), SEMBLANTE_MISMATCH);
  }
  {  // Another mesh than the table's.
    semblante_package package = small.view();
    const std::array<std::uint8_t, 32> other{};
    package.mesh_sha256 = other.data();
    EXPECT_EQ(create_result(package, &error), SEMBLANTE_MISMATCH);
    EXPECT_STREQ(error.where, "weights");
  }
  {  // A rig of another mesh.
    SmallPackage bad;
    bad.rig.mesh.sha256.fill(1);
    bad.rig_json = write_rig(bad.rig);
    EXPECT_EQ(create_result(bad.view(), &error), SEMBLANTE_MISMATCH);
  }
  {  // Every cut of the table, every cut of the rig.
    for (std::size_t size = 0; size < small.weights.size(); ++size) {
      semblante_package package = small.view();
      package.weights_size = size;
      EXPECT_NE(create_result(package, &error), SEMBLANTE_OK) << size;
    }
    for (std::size_t size = 0; size + 2 < small.rig_json.size(); size += 7) {
      semblante_package package = small.view();
      package.rig_json_size = size;
      EXPECT_EQ(create_result(package, &error), SEMBLANTE_MALFORMED) << size;
    }
  }
  {  // A share beyond one.
    const semblante_package package = small.view();
    semblante_head_options options{};
    options.size = sizeof(options);
    options.viseme_share = 1.5F;
    semblante_head* head = nullptr;
    EXPECT_EQ(semblante_head_create(&package, &options, &head, &error), SEMBLANTE_INVALID_ARGUMENT);
    EXPECT_STREQ(error.where, "options.viseme_share");
  }
}

std::vector<std::uint8_t> bytes_of(const std::string& file) {
  std::ifstream stream(SEMBLANTE_SOURCE_DIR "/protocol/vectors/" + file, std::ios::binary);
  EXPECT_TRUE(stream) << file;
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

/// A package of protocol/vectors.
OwnedHead golden_head(const std::string& folder) {
  const auto mesh = bytes_of(folder + "/mesh.drc");
  const auto weights = bytes_of(folder + "/weights");
  const auto rig = bytes_of(folder + "/rig.json");
  semblante_package package{};
  package.size = sizeof(package);
  package.mesh_drc = mesh.data();
  package.mesh_drc_size = mesh.size();
  package.weights = weights.data();
  package.weights_size = weights.size();
  package.rig_json = reinterpret_cast<const char*>(rig.data());
  package.rig_json_size = rig.size();
  semblante_head* head = nullptr;
  semblante_error error{};
  EXPECT_EQ(semblante_head_create(&package, nullptr, &head, &error), SEMBLANTE_OK) << error.where << error.message;
  return OwnedHead(head);
}

TEST(Head, Colors_AreThoseOfTheMesh) {
  const OwnedHead head = golden_head("face_colored");
  const std::uint8_t* colors = semblante_head_colors(head.get());
  ASSERT_NE(colors, nullptr);
  const float* rest = semblante_head_face(head.get())->rest;
  const std::size_t vertices = semblante_head_vertex_count(head.get());
  for (std::size_t axis = 0; axis < 3; ++axis) {  // of this mesh a colour is the place in the box
    float low = rest[axis];
    float high = low;
    for (std::size_t v = 0; v < vertices; ++v) {
      low = std::min(low, rest[3 * v + axis]);
      high = std::max(high, rest[3 * v + axis]);
    }
    for (std::size_t v = 0; v < vertices; ++v) {
      ASSERT_NEAR(colors[3 * v + axis], 255.0F * (rest[3 * v + axis] - low) / (high - low), 0.501F) << v;
    }
  }
}

TEST(Head, WithoutColors_GivesNull) {
  EXPECT_EQ(semblante_head_colors(golden_head("face").get()), nullptr);
  EXPECT_EQ(semblante_head_colors(make(SmallPackage()).get()), nullptr) << "a mesh that the caller decoded";
  EXPECT_EQ(semblante_head_colors(nullptr), nullptr);
}

TEST(Head, NeutralPose_GivesRestBitForBit) {
  const SmallPackage small;
  const OwnedHead head = make(small);
  EXPECT_EQ(semblante_head_vertex_count(head.get()), 4U);
  const std::array<float, 12> positions = positions_of(head.get());
  EXPECT_TRUE(std::equal(positions.begin(), positions.end(), small.positions.begin()));
}

TEST(Head, OpenJaw_MovesVerticesByTheirShare) {
  const SmallPackage small;
  const OwnedHead head = make(small);
  semblante_frame frame{};
  frame.fap[3] = 100;  // open_jaw: FP 2.1 down by 100 * MNS = 100 * 0.01 = 1
  ASSERT_EQ(semblante_head_set_frame(head.get(), &frame), SEMBLANTE_OK);
  const std::array<float, 12> positions = positions_of(head.get());
  EXPECT_NEAR(positions[1], -1.0F, quantization);        // 0 + 1 * -1
  EXPECT_NEAR(positions[4], 1.0F - 0.5F, quantization);  // 1 + 0.5 * -1
  EXPECT_EQ(positions[7], 1.0F);
  EXPECT_EQ(positions[10], 5.0F);
}

TEST(Head, Expression_MovesByItsSet) {
  const SmallPackage small;
  const OwnedHead head = make(small);
  semblante_frame frame{};
  frame.expression1 = 1;
  frame.intensity1 = 63;
  ASSERT_EQ(semblante_head_set_frame(head.get(), &frame), SEMBLANTE_OK);
  EXPECT_NEAR(positions_of(head.get())[4], 1.0F + 0.5F * 0.4F, quantization);
}

TEST(Head, YawOfTheLeftEye_TurnsOnlyItsVertices) {
  const SmallPackage small;
  const OwnedHead head = make(small);
  semblante_frame frame{};
  // FAP 23, yaw of the left eye, a quarter turn to the left: pi/2 / 1e-5 AU. The vertex is one before the pivot (+Z)
  // and comes to lie one to its left (+X): (1, 1, 0) + (1, 0, 0).
  frame.fap[23] = 157079.63F;
  ASSERT_EQ(semblante_head_set_frame(head.get(), &frame), SEMBLANTE_OK);
  const std::array<float, 12> positions = positions_of(head.get());
  EXPECT_NEAR(positions[6], 2.0F, 1e-5F);
  EXPECT_NEAR(positions[7], 1.0F, 1e-5F);
  EXPECT_NEAR(positions[8], 0.0F, 1e-5F);
  EXPECT_EQ(positions[9], 5.0F);
}

TEST(Head, Interpolated_IsHalfWayAtHalf) {
  const SmallPackage small;
  const OwnedHead head = make(small);
  const semblante_frame neutral{};
  semblante_frame open{};
  open.fap[3] = 100;
  ASSERT_EQ(semblante_head_set_interpolated(head.get(), &neutral, &open, 0.5F), SEMBLANTE_OK);
  EXPECT_NEAR(positions_of(head.get())[1], -0.5F, quantization);
}

TEST(Head, Interpolated_OutsideOfItsFrames_IsTheNearerOne) {
  const SmallPackage small;
  const OwnedHead head = make(small);
  const semblante_frame neutral{};
  semblante_frame open{};
  open.fap[3] = 100;
  ASSERT_EQ(semblante_head_set_interpolated(head.get(), &neutral, &open, 1.5F), SEMBLANTE_OK);
  EXPECT_NEAR(positions_of(head.get())[1], -1.0F, quantization);
  ASSERT_EQ(semblante_head_set_interpolated(head.get(), &neutral, &open, -0.5F), SEMBLANTE_OK);
  EXPECT_NEAR(positions_of(head.get())[1], 0.0F, quantization);
}

TEST(Head, PoseOfTheCallers_IsWhatIsShown) {
  const SmallPackage small;
  const OwnedHead head = make(small);
  semblante_pose pose{};
  ASSERT_EQ(semblante_head_get_pose(head.get(), &pose), SEMBLANTE_OK);
  pose.fp[0] = 0.25F;  // FP 2.1 is the first of the 84
  ASSERT_EQ(semblante_head_set_pose(head.get(), &pose), SEMBLANTE_OK);
  EXPECT_NEAR(positions_of(head.get())[0], 0.25F, quantization);
}

TEST(Head, BadArguments_AreRefusedAndChangeNothing) {
  const SmallPackage small;
  const OwnedHead head = make(small);
  semblante_frame frame{};
  frame.fap[3] = std::numeric_limits<float>::infinity();
  EXPECT_EQ(semblante_head_set_frame(head.get(), &frame), SEMBLANTE_INVALID_ARGUMENT);
  EXPECT_EQ(semblante_head_set_frame(head.get(), nullptr), SEMBLANTE_INVALID_ARGUMENT);
  EXPECT_EQ(semblante_head_set_frame(nullptr, &frame), SEMBLANTE_INVALID_ARGUMENT);
  semblante_pose pose{};
  pose.head_rotation[2] = std::nanf("");
  EXPECT_EQ(semblante_head_set_pose(head.get(), &pose), SEMBLANTE_INVALID_ARGUMENT);
  std::array<float, 12> positions{};
  positions.fill(7.0F);
  EXPECT_EQ(semblante_head_positions(head.get(), positions.data(), 11), SEMBLANTE_BUFFER_TOO_SMALL);
  EXPECT_EQ(positions[0], 7.0F);
  EXPECT_EQ(positions_of(head.get())[0], small.positions[0]);
  EXPECT_EQ(semblante_head_vertex_count(nullptr), 0U);
  EXPECT_EQ(semblante_head_rig(nullptr), nullptr);
}

TEST(Head, VisemeShareOption_ReplacesTheRigs) {
  const SmallPackage small;
  EXPECT_FLOAT_EQ(semblante_head_rig(make(small).get())->viseme_share, 0.85F);
  semblante_head_options options{};
  options.size = sizeof(options);
  options.viseme_share = 0.5F;
  const OwnedHead head = make(small, &options);
  EXPECT_FLOAT_EQ(semblante_head_rig(head.get())->viseme_share, 0.5F);
}

TEST(Head, SetVisemeShare_AtAPointThatBothMove_SplitsByIt) {
  SmallPackage small;
  const FeaturePointId chin = *parse_feature_point("2.1");
  small.rig.visemes[10].displacements.push_back({chin, glm::vec3(0, -1, 0)});
  small.rig.expressions[1].displacements.push_back({chin, glm::vec3(0.5F, 0, 0)});
  small.seal();
  const OwnedHead head = make(small);
  semblante_frame frame{};
  frame.viseme1 = 10;
  frame.viseme_blend = SEMBLANTE_BLEND_MAX;
  frame.expression1 = 1;
  frame.intensity1 = SEMBLANTE_BLEND_MAX;
  for (const float share : {0.0F, 0.25F, 1.0F}) {
    ASSERT_EQ(semblante_head_set_viseme_share(head.get(), share), SEMBLANTE_OK);
    ASSERT_EQ(semblante_head_set_frame(head.get(), &frame), SEMBLANTE_OK);
    const auto positions = positions_of(head.get());
    EXPECT_NEAR(positions[0], (1 - share) * 0.5F, quantization) << share;
    EXPECT_NEAR(positions[1], -share, quantization) << share;
  }
  for (const float share : {-0.01F, 1.01F, std::numeric_limits<float>::quiet_NaN()}) {
    EXPECT_EQ(semblante_head_set_viseme_share(head.get(), share), SEMBLANTE_INVALID_ARGUMENT);
  }
  EXPECT_EQ(semblante_head_rig(head.get())->viseme_share, 1.0F) << "what is refused changes nothing";
  EXPECT_EQ(semblante_head_set_viseme_share(nullptr, 0.5F), SEMBLANTE_INVALID_ARGUMENT);
}

TEST(Sdk, UsedFromC_DeformsTheHead) {
  const SmallPackage small;
  const semblante_package package = small.view();
  std::array<float, 12> positions{};
  ASSERT_EQ(open_jaw_from_c(&package, positions.data(), positions.size()), SEMBLANTE_OK);
  EXPECT_NEAR(positions[1], -1.0F, quantization);
  EXPECT_EQ(open_jaw_from_c(&package, positions.data(), 3), SEMBLANTE_BUFFER_TOO_SMALL);
}

TEST(Sdk, ResultNames_AreDistinct) {
  std::vector<std::string> names;
  for (int result = SEMBLANTE_OK; result <= SEMBLANTE_UNAVAILABLE; ++result) {
    names.emplace_back(semblante_result_name(static_cast<semblante_result>(result)));
  }
  std::sort(names.begin(), names.end());
  EXPECT_EQ(std::unique(names.begin(), names.end()), names.end());
  EXPECT_EQ(semblante_sdk_version(), SEMBLANTE_SDK_VERSION);
}

TEST(HeadUpdatePositions, GivesWhatAllPositionsWouldBe) {
  const SmallPackage small;
  const OwnedHead head = make(small);
  std::array<float, 12> updated = positions_of(head.get());
  semblante_pose before{};
  ASSERT_EQ(semblante_head_get_pose(head.get(), &before), SEMBLANTE_OK);
  semblante_frame frame{};
  frame.fap[3] = 300.0F;
  ASSERT_EQ(semblante_head_set_frame(head.get(), &frame), SEMBLANTE_OK);
  ASSERT_EQ(semblante_head_update_positions(head.get(), &before, updated.data(), updated.size()), SEMBLANTE_OK);
  EXPECT_EQ(updated, positions_of(head.get()));

  EXPECT_EQ(semblante_head_update_positions(head.get(), &before, updated.data(), 11), SEMBLANTE_BUFFER_TOO_SMALL);
  EXPECT_EQ(semblante_head_update_positions(nullptr, &before, updated.data(), 12), SEMBLANTE_INVALID_ARGUMENT);
  EXPECT_EQ(semblante_head_update_positions(head.get(), nullptr, updated.data(), 12), SEMBLANTE_INVALID_ARGUMENT);
  before.fp[5] = std::numeric_limits<float>::infinity();
  EXPECT_EQ(semblante_head_update_positions(head.get(), &before, updated.data(), 12), SEMBLANTE_INVALID_ARGUMENT);
}

TEST(HeadNormals, FollowTheFace_AndNeedTriangles) {
  const SmallPackage small;
  const std::array<std::uint32_t, 6> triangles{0, 1, 2, 0, 2, 3};
  const std::array<float, 12> leaning{3, 0, 4, 0, 0, 2, 0, 0, 0, 0, 0, 1};  // of any length; zero: none
  semblante_package package = small.view();
  package.triangles = triangles.data();
  package.triangle_count = 2;
  package.normals = leaning.data();
  semblante_head* made = nullptr;
  ASSERT_EQ(semblante_head_create(&package, nullptr, &made, nullptr), SEMBLANTE_OK);
  const OwnedHead head(made);
  std::array<float, 12> normals{};
  const auto expect_normal = [&](std::size_t v, const std::array<float, 3>& expected) {
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(normals[3 * v + k], expected[k], 1e-6F) << v;
  };
  ASSERT_EQ(semblante_head_normals(head.get(), small.positions.data(), normals.data(), normals.size()), SEMBLANTE_OK);
  expect_normal(0, {0.6F, 0, 0.8F});
  expect_normal(1, {0, 0, 1});
  const float even = std::sqrt(0.5F);
  expect_normal(2, {even, 0, -even});  // of the triangles

  std::array<float, 12> corner{};  // a quarter turn about y: (x, y, z) -> (z, y, -x)
  for (std::size_t v = 0; v < 12; v += 3) {
    corner[v] = small.positions[v + 2], corner[v + 1] = small.positions[v + 1], corner[v + 2] = -small.positions[v];
  }
  ASSERT_EQ(semblante_head_normals(head.get(), corner.data(), normals.data(), normals.size()), SEMBLANTE_OK);
  expect_normal(0, {0.8F, 0, -0.6F});
  expect_normal(1, {1, 0, 0});
  expect_normal(2, {-even, 0, -even});
  EXPECT_EQ(semblante_head_normals(head.get(), corner.data(), normals.data(), 11), SEMBLANTE_BUFFER_TOO_SMALL);
  EXPECT_EQ(semblante_head_normals(make(small).get(), corner.data(), normals.data(), 12), SEMBLANTE_INVALID_ARGUMENT);

  semblante_error error{};
  const std::array<std::uint32_t, 6> beyond{0, 1, 2, 0, 2, 4};
  package.triangles = beyond.data();
  EXPECT_EQ(create_result(package, &error), SEMBLANTE_INVALID_ARGUMENT);
  EXPECT_STREQ(error.where, "package.triangles");
  package.triangles = triangles.data();
  package.normals = nullptr;
  EXPECT_EQ(create_result(package, &error), SEMBLANTE_INVALID_ARGUMENT);
}

}  // namespace
}  // namespace semblante::testing
