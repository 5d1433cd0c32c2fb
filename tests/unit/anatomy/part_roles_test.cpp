#include "core/anatomy/part_roles.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "core/anatomy/jaw_share.h"
#include "core/anatomy/role_by_name.h"
#include "tests/support/meshes.h"
#include "tests/support/sample_head_model.h"

namespace semblante {
namespace {

/// A cartoon of a head, ES0 = 6: a plate of skin at z = 0 from (-10, -12) to (10, 12), eyeballs that look through it at
/// (3, 4) and (-3, 4), teeth and a tongue behind the mouth at (0, -3), lashes, hair.
class CartoonHead : public ::testing::Test {
 protected:
  CartoonHead() {
    Model plate = testing::make_grid(40, 48);
    for (glm::vec3& p : plate.positions) p = glm::vec3(p.x / 2 - 10, p.y / 2 - 12, 0);
    add(plate, "head");
  }
  std::uint32_t add(const Model& part, const std::string& name) {
    return testing::append(model_, part, with_names_ ? name : "");
  }
  void add_all() {
    add(testing::make_ball({3, 4, -1.2F}, 1.3F), "EyeLeft");
    add(testing::make_ball({-3, 4, -1.2F}, 1.3F), "EyeRight");
    add(testing::make_ball({3, 4, -0.5F}, 0.5F), "iris");
    add(arch(-2.0F), "TeethUpper");
    add(arch(-4.0F), "TeethLower");
    add(testing::make_box({-1.5F, -4.5F, -6}, {1.5F, -3.2F, -2}), "");
    // A closed box has no vertex in its middle; a tongue has.
    model_.positions.emplace_back(0.1F, -3.2F, -4);
    model_.positions.emplace_back(-0.1F, -3.2F, -4);
    model_.positions.emplace_back(0, -3.1F, -4);
    const auto top = static_cast<std::uint32_t>(model_.positions.size());
    model_.triangles.push_back({top - 3, top - 2, top - 1});
    model_.triangles.push_back({top - 3, top - 2, top - 4});
    model_.primitives.back().triangle_count += 2;
    add(testing::make_box({2, 5, 0.1F}, {4, 5.2F, 0.6F}), "lashes");
    add(testing::make_ball({0, 8, -6}, 9), "hair");
    surface_ = build_surface(model_);
  }
  /// Half a ring of teeth, open to the back.
  static Model arch(float y) {
    std::vector<glm::vec3> positions;
    std::vector<Triangle> triangles;
    for (std::uint32_t i = 0; i <= 12; ++i) {
      const double angle = 3.14159 * i / 12;
      for (const float h : {-0.7F, 0.7F}) {
        positions.emplace_back(2.5 * std::cos(angle), y + h, -4.5 + 3.5 * std::sin(angle));
      }
      if (i == 12) break;
      triangles.push_back({2 * i, 2 * i + 2, 2 * i + 1});
      triangles.push_back({2 * i + 1, 2 * i + 2, 2 * i + 3});
    }
    return testing::make_model(positions, triangles);
  }
  [[nodiscard]] FeaturePointSet face_points() const {
    const auto at = [&](float x, float y) { return static_cast<std::uint32_t>((y + 12) * 2 * 41 + (x + 10) * 2); };
    return testing::points_at(model_, {{"2.1", at(0, -7)},
                                       {"2.2", at(0, -3)},
                                       {"2.3", at(0, -3.5F)},
                                       {"3.1", at(3, 5)},
                                       {"3.2", at(-3, 5)},
                                       {"3.3", at(3, 3)},
                                       {"3.4", at(-3, 3)}});
  }
  [[nodiscard]] std::vector<std::string> roles(const FeaturePointSet& points) const {
    std::vector<std::string> names;
    for (const Part& part : describe_parts(model_, surface_, points)) {
      names.emplace_back(part_role_names[static_cast<std::size_t>(part.role)]);
    }
    return names;
  }

  bool with_names_ = true;
  Model model_;
  Surface surface_;
};

const std::vector<std::string> cartoon_roles = {"skin",        "left_eye", "right_eye", "left_eye", "upper_teeth",
                                                "lower_teeth", "tongue",   "attached",  "rest"};

TEST_F(CartoonHead, WithoutNames_PlaceAndSizeTellTheParts) {
  with_names_ = false;
  add_all();
  EXPECT_EQ(roles(face_points()), cartoon_roles);
}

TEST_F(CartoonHead, WithoutPoints_NamesTell) {
  add_all();
  EXPECT_EQ(roles({}), cartoon_roles);
}

TEST_F(CartoonHead, PointsOnAPart_BeatItsName) {
  const std::uint32_t ball = add(testing::make_ball({3, 4, -1.2F}, 1.3F), "hair clip");
  surface_ = build_surface(model_);
  FeaturePointSet points = testing::points_at(model_, {{"2.1", 5}, {"3.5", ball}});
  EXPECT_EQ(describe_parts(model_, surface_, points)[1].role, PartRole::left_eye);
}

// The shell about the right eye has the place and size of an eyeball.
TEST_F(CartoonHead, ALidOfItsOwnWithoutAPoint_GoesWithItsMirrorImage) {
  with_names_ = false;
  const auto add_shell = [&](float x) {
    Model shell = testing::make_ball({x, 4, -1.2F}, 1.4F);
    std::erase_if(shell.triangles, [&](const Triangle& t) {
      return std::any_of(t.begin(), t.end(), [&](std::uint32_t v) { return shell.positions[v].y < 3.6F; });
    });
    shell.primitives.front().triangle_count = static_cast<std::uint32_t>(shell.triangles.size());
    return add(shell, "");
  };
  const std::uint32_t left = add_shell(3);
  add_shell(-3);
  add_all();
  FeaturePointSet points = face_points();
  std::erase_if(points, [](const FeaturePoint& p) { return to_string(p.id) == "3.1" || to_string(p.id) == "3.2"; });
  points.push_back(testing::points_at(model_, {{"3.1", left}}).front());
  const auto role_at = [&](float x) {
    for (const Part& part : describe_parts(model_, surface_, points)) {
      const bool is_shell = part.triangle_count > 0 && part.box_max.y > 5.35F && part.box_max.y < 5.45F;
      if (is_shell && part.box_min.x < x && part.box_max.x > x) return part.role;
    }
    return PartRole::rest;
  };
  EXPECT_EQ(role_at(3), PartRole::skin);
  EXPECT_EQ(role_at(-3), PartRole::skin);
}

TEST_F(CartoonHead, RoleByUser_BeatsEverything) {
  const std::uint32_t ball = add(testing::make_ball({3, 4, -1.2F}, 1.3F), "EyeLeft");
  surface_ = build_surface(model_);
  const FeaturePointSet points = testing::points_at(model_, {{"2.1", 5}, {"3.5", ball}});
  const std::vector<std::optional<PartRole>> by_user = {std::nullopt, PartRole::rest};
  const auto parts = describe_parts(model_, surface_, points, by_user);
  EXPECT_EQ(parts[1].role, PartRole::rest);
  EXPECT_TRUE(parts[1].role_by_user);
  EXPECT_FALSE(parts[0].role_by_user);
}

TEST_F(CartoonHead, Facts_AreThoseOfThePart) {
  add(testing::make_box({2, 5, 0.25F}, {4, 5.5F, 0.5F}), "lashes");
  surface_ = build_surface(model_);
  const Part part = describe_parts(model_, surface_, {})[1];
  EXPECT_EQ(part.name, "lashes");
  EXPECT_EQ(part.vertex_count, 8U);
  EXPECT_EQ(part.triangle_count, 12U);
  EXPECT_EQ(part.box_min, glm::vec3(2, 5, 0.25F));
  EXPECT_EQ(part.box_max, glm::vec3(4, 5.5F, 0.5F));
}

TEST_F(CartoonHead, VerticesWithoutTriangles_AreOnePartAtRest) {
  model_.positions.emplace_back(0, 0, 9);
  model_.positions.emplace_back(0, 1, 9);
  surface_ = build_surface(model_);
  const auto parts = describe_parts(model_, surface_, {});
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_EQ(parts[1].role, PartRole::rest);
  EXPECT_EQ(parts[1].vertex_count, 2U);
}

TEST_F(CartoonHead, EmptyModel_HasNoParts) {
  const Model nothing;
  EXPECT_TRUE(describe_parts(nothing, build_surface(nothing), {}).empty());
}

TEST_F(CartoonHead, OneNameForAll_MaterialsTellThePartsApart) {
  const std::uint32_t ball = add(testing::make_ball({3, 4, -1.2F}, 1.3F), "head");
  ASSERT_GT(ball, 0U);
  model_.materials = {{.name = "skin"}, {.name = "Hair"}};
  model_.primitives[0].material = 0;
  model_.primitives.back().material = 1;
  surface_ = build_surface(model_);
  const auto parts = describe_parts(model_, surface_, {});
  EXPECT_EQ(parts[0].name, "skin");
  EXPECT_EQ(parts[1].name, "Hair");
  EXPECT_EQ(parts[1].role, PartRole::rest);  // by its place it would be an eye
}

TEST_F(CartoonHead, HairInOnePiece_IsNotAttachedHoweverCloseItLies) {
  add(testing::make_box({-8, 6, 0.1F}, {8, 11, 0.6F}), "");
  surface_ = build_surface(model_);
  EXPECT_EQ(describe_parts(model_, surface_, face_points())[1].role, PartRole::rest);
}

TEST_F(CartoonHead, ABeardInOnePiece_GoesWithTheJaw_AndAScarfDoesNot) {
  add(testing::make_box({-8, -9, 0.1F}, {8, 1, 0.4F}), "");    // from ear to ear, around the mouth
  add(testing::make_box({-8, -12, 0.1F}, {8, -6, 0.4F}), "");  // begins below the mouth
  add(testing::make_box({-9, -11, 0.1F}, {9, 10, 0.4F}), "");  // begins above the eyes: hair
  add(testing::make_box({-8, -9, 0.1F}, {8, 1, 4.0F}), "");    // far from the skin: a microphone
  surface_ = build_surface(model_);
  EXPECT_EQ(roles(face_points()), (std::vector<std::string>{"skin", "attached", "rest", "rest", "rest"}));
}

/// Frame with its arms along the temples, and lenses and pads of their own, all one primitive.
TEST_F(CartoonHead, Glasses_WithoutATellingName_AreAtRest_WithAllTheirParts) {
  add(testing::make_box({-6, 3, 0.4F}, {6, 5, 0.5F}), "Accessory_03");          // the frame
  add(testing::make_box({5.6F, 4, -9}, {5.9F, 4.3F, -0.1F}), "Accessory_03");   // an arm
  add(testing::make_box({2, 3.5F, 0.5F}, {4, 4.5F, 0.6F}), "Accessory_03");     // a lens
  add(testing::make_box({0.4F, 3.5F, 0.1F}, {0.6F, 4, 0.3F}), "Accessory_03");  // a pad
  add(testing::make_box({2, 5, 0.1F}, {4, 5.2F, 0.6F}), "Material.002");        // lashes, whatever their name
  surface_ = build_surface(model_);
  EXPECT_EQ(roles(face_points()), (std::vector<std::string>{"skin", "rest", "rest", "rest", "rest", "attached"}));
}

TEST_F(CartoonHead, AnArmOfGlasses_AloneAndWithoutAName_IsTooDeepToBeLashes) {
  for (glm::vec3& p : model_.positions) p.z = p.x < 5.5F ? p.z : -1.5F * (p.x - 5.5F);  // the side of the head
  add(testing::make_box({6, 4, -6}, {6.2F, 4.3F, -0.3F}), "");
  surface_ = build_surface(model_);
  EXPECT_EQ(roles(face_points()), (std::vector<std::string>{"skin", "rest"}));
}

/// Half a ring, its ends joined by a floor or a palate at the height `plate`.
Model bridged(Model arch, float plate) {
  const auto first = static_cast<std::uint32_t>(arch.positions.size());
  for (const float z : {-4.4F, -3.0F, -1.6F}) arch.positions.emplace_back(0, plate, z);
  for (std::uint32_t i = 0; i < 3; ++i) {
    arch.triangles.push_back({2 * i, first + i, 2 * i + 2});
    arch.triangles.push_back({22 - 2 * i, 24 - 2 * i, first + i});
    arch.primitives.back().triangle_count += 2;
  }
  return arch;
}

/// Ready Player Me: one mesh "Wolf3D_Teeth" with both rows, gums and the tongue.
TEST_F(CartoonHead, EyeballsJoinedToOnePart_AreNeitherEye) {
  Model balls = testing::make_ball({3, 4, -1.2F}, 1.3F);
  testing::append(balls, testing::make_ball({-3, 4, -1.2F}, 1.3F), "");
  const auto half = static_cast<std::uint32_t>(balls.positions.size() / 2);
  balls.triangles.push_back({0, 1, half});  // a strip between them
  balls.primitives.back().triangle_count += 1;
  add(balls, "Eyes");
  surface_ = build_surface(model_);
  EXPECT_EQ(roles(face_points()), (std::vector<std::string>{"skin", "rest"}));
  FeaturePointSet with_pupil = face_points();
  with_pupil.push_back({testing::fp("3.5"), VertexId(static_cast<std::uint32_t>(41 * 49)), {3, 4, 0}});
  EXPECT_EQ(roles(with_pupil), (std::vector<std::string>{"skin", "rest"})) << "a pupil marked on it";
}

TEST_F(CartoonHead, TheTongueInAMeshOfTeeth_IsATongue) {
  for (const bool has_points : {true, false}) {
    for (const bool has_plates : {false, true}) {
      model_ = Model{};
      Model plate = testing::make_grid(40, 48);
      for (glm::vec3& p : plate.positions) p = glm::vec3(p.x / 2 - 10, p.y / 2 - 12, 0);
      add(plate, "Wolf3D_Head");
      add(testing::make_ball({3, 4, -1.2F}, 1.3F), "EyeLeft");
      add(testing::make_ball({-3, 4, -1.2F}, 1.3F), "EyeRight");
      // The tongue first and rather high: neither order nor height tell it from teeth.
      Model tongue = testing::make_ball({0, -2.2F, -4}, 1.0F);
      for (glm::vec3& p : tongue.positions) p = {p.x * 1.4F, p.y, -4 + (p.z + 4) * 2};
      add(tongue, "Wolf3D_Teeth");
      add(has_plates ? bridged(arch(-2.0F), -0.9F) : arch(-2.0F), "Wolf3D_Teeth");
      add(has_plates ? bridged(arch(-4.0F), -4.9F) : arch(-4.0F), "Wolf3D_Teeth");
      surface_ = build_surface(model_);
      EXPECT_EQ(roles(has_points ? face_points() : FeaturePointSet{}),
                (std::vector<std::string>{"skin", "left_eye", "right_eye", "tongue", "upper_teeth", "lower_teeth"}))
          << has_points << has_plates;
    }
  }
}

TEST_F(CartoonHead, AMeshOfTeethWithoutATongue_HasNone) {
  add(testing::make_ball({3, 4, -1.2F}, 1.3F), "EyeLeft");
  add(testing::make_ball({-3, 4, -1.2F}, 1.3F), "EyeRight");
  add(bridged(arch(-2.0F), -0.9F), "Wolf3D_Teeth");
  add(bridged(arch(-4.0F), -4.9F), "Wolf3D_Teeth");
  surface_ = build_surface(model_);
  EXPECT_EQ(roles(face_points()),
            (std::vector<std::string>{"skin", "left_eye", "right_eye", "upper_teeth", "lower_teeth"}));
}

/// Both rows joined at the back, as where a modeller has welded everything inside the mouth.
TEST_F(CartoonHead, BothRowsInOnePart_OpenWithTheJaw) {
  Model rows = arch(-2.0F);
  const Model lower = arch(-4.0F);
  const auto first = static_cast<std::uint32_t>(rows.positions.size());
  rows.positions.insert(rows.positions.end(), lower.positions.begin(), lower.positions.end());
  for (const Triangle& t : lower.triangles) rows.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  for (const std::uint32_t end : {0U, 22U}) {
    rows.triangles.push_back({end, end + 2, first + end + 1});
    rows.triangles.push_back({end + 2, first + end + 3, first + end + 1});
  }
  rows.primitives.back().triangle_count = static_cast<std::uint32_t>(rows.triangles.size());
  const std::uint32_t teeth = add(rows, "Wolf3D_Teeth");
  surface_ = build_surface(model_);
  FeaturePointSet points = face_points();
  const auto at = [&](float x, float y) { return static_cast<std::uint32_t>((y + 12) * 2 * 41 + (x + 10) * 2); };
  for (const FeaturePoint& corner :
       testing::points_at(model_, {{"3.7", at(2, 4)}, {"3.8", at(-2, 4)}, {"3.11", at(4, 4)}, {"3.12", at(-4, 4)}})) {
    points.push_back(corner);
  }
  std::sort(points.begin(), points.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
  const auto parts = describe_parts(model_, surface_, points);
  ASSERT_EQ(parts.size(), 2U);
  const auto shares = share_of_jaw(surface_, parts, surface_points(surface_, points));
  const auto share_at = [&](std::uint32_t vertex) { return shares[surface_.surface_of[teeth + vertex].value()].jaw; };
  for (const std::uint32_t front : {10U, 11U, 12U, 13U, 14U, 15U}) {
    EXPECT_EQ(share_at(front), 0.0) << front;
    EXPECT_EQ(share_at(first + front), 1.0) << front;
  }
}

/// The real shapes of our own head, in the one mesh that Ready Player Me makes of them: the tongue goes with the jaw.
TEST(ReadyPlayerMe, TeethAndTongueInOneMesh_MoveAsTheyShould) {
  const Model own = testing::sample_head_model();
  Model model = own;
  const Surface surface = build_surface(model);
  for (Primitive& primitive : model.primitives) {
    for (const std::string_view word : {"teeth", "gum", "tongue"}) {
      if (primitive.name.find(word) != std::string::npos) primitive.name = "Wolf3D_Teeth";
    }
  }
  for (const FeaturePointSet& points : {FeaturePointSet{}, testing::sample_head_points()}) {
    const auto before = describe_parts(own, surface, points);
    const auto parts = describe_parts(model, surface, points);
    ASSERT_EQ(parts.size(), before.size());
    std::size_t in_mouth = 0;
    for (std::size_t p = 0; p < parts.size(); ++p) {
      EXPECT_EQ(part_role_names[static_cast<std::size_t>(parts[p].role)],
                part_role_names[static_cast<std::size_t>(before[p].role)])
          << parts[p].name << " " << p << (points.empty() ? " without points" : "");
      in_mouth += parts[p].name == "Wolf3D_Teeth" ? 1 : 0;
    }
    EXPECT_GE(in_mouth, 3U);
    const auto shares = share_of_jaw(surface, parts, {});
    for (std::size_t p = 0; p < parts.size(); ++p) {
      if (parts[p].role != PartRole::tongue) continue;
      for (const SurfaceVertexId v : surface.members_of(PartId(static_cast<std::uint32_t>(p)))) {
        ASSERT_EQ(shares[v.value()].jaw, 1.0);
      }
    }
  }
}

/// A character of VRoid: meshes named alike, materials that tell; the body is larger than the face.
class VroidCharacter : public CartoonHead {
 protected:
  VroidCharacter() {
    model_ = Model{};
    Model body = testing::make_grid(80, 80);
    for (glm::vec3& p : body.positions) p = glm::vec3(p.x / 2 - 20, p.y / 2 - 60, -5);
    add_material(body, "Body (merged)", "N00_000_00_Body_00_SKIN (Instance)");
    add_material(testing::make_box({-15, -55, -6}, {15, -25, -4}), "Body (merged)",
                 "N00_002_03_Tops_01_CLOTH (Instance)");
    Model face = testing::make_grid(40, 48);
    for (glm::vec3& p : face.positions) p = glm::vec3(p.x / 2 - 10, p.y / 2 - 12, 0);
    add_material(face, "Face (merged)", "N00_000_00_Face_00_SKIN (Instance)");
    add_material(testing::make_box({2, 5, 0.1F}, {4, 5.2F, 0.6F}), "Face (merged)", "N00_000_00_FaceEyeline_00_FACE");
    add_material(testing::make_box({2, 5.4F, 0.1F}, {4, 5.6F, 0.6F}), "Face (merged)",
                 "N00_000_00_FaceEyelash_00_FACE");
    add_material(testing::make_box({2, 6.4F, 0.1F}, {4, 6.6F, 0.6F}), "Face (merged)", "N00_000_00_FaceBrow_00_FACE");
    add_material(testing::make_ball({3, 4, -1.2F}, 1.3F), "Face (merged)", "N00_000_00_EyeWhite_00_EYE");
    add_material(testing::make_ball({-3, 4, -1.2F}, 1.3F), "Face (merged)", "N00_000_00_EyeIris_00_EYE");
    add_material(testing::make_ball({0, 8, -6}, 9), "Hair001 (merged)", "N00_000_Hair_00_HAIR");
    surface_ = build_surface(model_);
  }
  void add_material(const Model& part, const std::string& mesh, const std::string& material) {
    add(part, mesh);
    model_.primitives.back().material = static_cast<int>(model_.materials.size());
    model_.materials.push_back({.name = material});
  }
};

TEST_F(VroidCharacter, WithoutPoints_TheFaceIsTheSkin_AndTheBodyIsNot) {
  EXPECT_EQ(roles({}), (std::vector<std::string>{"rest", "rest", "skin", "attached", "attached", "attached", "left_eye",
                                                 "right_eye", "rest"}));
}

TEST_F(CartoonHead, ASkinThatIsNamedBody_IsTheSkin_AndItsEyesAreEyes) {
  // As of MakeHuman: the face is part of the mesh "body", and so are the eyeballs.
  model_.primitives.back().name = "body";
  add(testing::make_ball({3, 4, -1.2F}, 1.3F), "body");
  add(testing::make_ball({-3, 4, -1.2F}, 1.3F), "body");
  add(testing::make_box({-15, -55, -6}, {15, -25, -4}), "jeans01");
  surface_ = build_surface(model_);
  EXPECT_EQ(roles(face_points()), (std::vector<std::string>{"skin", "left_eye", "right_eye", "rest"}));
  EXPECT_EQ(roles({}).front(), "skin");
}

TEST(RegionByName, FaceAndBody_AreToldApart) {
  const auto region = [](const char* name, const char* material) {
    PartShape shape;
    shape.name = name;
    shape.material = material;
    return is_face_name(shape) ? "face" : is_body_name(shape) ? "body" : has_name_of_another_part(shape) ? "other" : "";
  };
  EXPECT_STREQ(region("Face (merged)", "N00_000_00_Face_00_SKIN"), "face");
  EXPECT_STREQ(region("Body (merged)", "N00_000_00_Face_00_SKIN"), "face");
  EXPECT_STREQ(region("Face (merged)", "N00_000_00_FaceMouth_00_FACE"), "other");
  EXPECT_STREQ(region("Face (merged)", "N00_000_00_FaceEyeline_00_FACE"), "other");
  EXPECT_STREQ(region("Face (merged)", "Material.001"), "face");
  EXPECT_STREQ(region("Body (merged)", "N00_000_00_HairBack_00_HAIR"), "other");
  EXPECT_STREQ(region("Wolf3D_Head", "Wolf3D_Skin"), "face");
  EXPECT_STREQ(region("Wolf3D_Body", "Wolf3D_Body"), "body");
  EXPECT_STREQ(region("Wolf3D_Outfit_Top", ""), "body");
  EXPECT_STREQ(region("Wolf3D_Headwear", ""), "other");
  EXPECT_STREQ(region("CC_Base_Body", "Std_Skin_Arm"), "body");
  EXPECT_STREQ(region("CC_Base_Body", "Std_Skin_Head"), "face");
  EXPECT_STREQ(region("Armature", "Legacy Shader"), "") << "no arm, no leg";
  EXPECT_STREQ(region("neckTie", "tie.002"), "body");
}

struct NameCase {
  const char* name;
  double x;
  std::optional<PartRole> role;
};

TEST(RoleByName, NamesInUse_SayWhatTheySay) {
  for (const auto& [name, x, role] : std::vector<NameCase>{{"EyeLeft", 3, PartRole::left_eye},
                                                           {"eye.R", 3, PartRole::right_eye},
                                                           {"l_eye", 3, PartRole::left_eye},
                                                           {"Eyeball", -3, PartRole::right_eye},
                                                           {"M_EyeLashes", 3, PartRole::attached},
                                                           {"eyebrow_left", 3, PartRole::attached},
                                                           {"EyeOcclusion", 3, PartRole::attached},
                                                           {"glasses", 0, PartRole::rest},
                                                           {"Sunglasses_browline", 0, PartRole::rest},
                                                           {"spectacles", 0, PartRole::rest},
                                                           {"N00_000_00_FaceEyeline_00_FACE", 3, PartRole::attached},
                                                           {"Eyeliner", 3, PartRole::attached},
                                                           {"Wolf3D_Headwear", 0, PartRole::rest},
                                                           {"Wolf3D_Outfit_Top", 0, PartRole::rest},
                                                           {"N00_000_00_Body_00_SKIN", 0, PartRole::rest},
                                                           {"Eyeglasses", 0, PartRole::rest},
                                                           {"Wolf3D_Hair", 0, PartRole::rest},
                                                           {"teeth-upper", 0, PartRole::upper_teeth},
                                                           {"Gums_Lower", 0, PartRole::lower_teeth},
                                                           {"Wolf3D_Teeth", 0, std::nullopt},
                                                           {"Tongue", 0, PartRole::tongue},
                                                           {"GumsTongue", 0, PartRole::tongue},
                                                           {"Wolf3D_Head", 0, std::nullopt},
                                                           {"Material.001", 0, std::nullopt},
                                                           {"", 0, std::nullopt}}) {
    std::vector<PartShape> shapes(2);
    shapes[0].low.x = -10;
    shapes[0].high.x = 10;
    shapes[1].name = name;
    shapes[1].center.x = x;
    shapes[1].triangles = 1;
    std::vector<std::optional<PartRole>> roles = {PartRole::skin, std::nullopt};
    guess_roles_by_name(shapes, roles);
    EXPECT_EQ(roles[1], role) << name;
  }
}

TEST(RoleByName, ALid_IsToldFromOtherWordsWithItsLetters) {
  for (const char* const name : {"upper lids", "EyelidLeft", "Eye_Lid_R", "Lid"})
    EXPECT_TRUE(is_lid_name(name)) << name;
  for (const char* const name : {"eyelashes", "Solid", "slider", "collider", ""})
    EXPECT_FALSE(is_lid_name(name)) << name;
}

TEST(RoleByName, OneNameOnBothSides_IsOfTheEyeWhereItLies) {
  std::vector<PartShape> shapes(4);
  shapes[0].low.x = -10;
  shapes[0].high.x = 10;
  for (std::size_t p = 1; p < shapes.size(); ++p) shapes[p].triangles = 1;
  shapes[1].name = shapes[2].name = "Eye.L";
  shapes[1].center.x = 3;
  shapes[2].center.x = -3;
  shapes[3].name = "Eye.R";
  shapes[3].center.x = 4;
  std::vector<std::optional<PartRole>> roles(shapes.size());
  roles[0] = PartRole::skin;
  guess_roles_by_name(shapes, roles);
  EXPECT_EQ(roles[1], PartRole::left_eye);
  EXPECT_EQ(roles[2], PartRole::right_eye);
  EXPECT_EQ(roles[3], PartRole::right_eye) << "the name says more than the place";
}

}  // namespace
}  // namespace semblante
