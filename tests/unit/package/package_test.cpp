// The face package against the model and rig it was made from.
#include "protocol/package/package.h"

#include <cmath>
#include <map>

#include <glm/geometric.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/draco/draco_mesh.h"
#include "core/geometry/smooth_normals.h"
#include "core/materials/materials.h"
#include "protocol/cpp/rig_document.h"
#include "protocol/cpp/weights_format.h"
#include "protocol/package/mesh_encoding.h"
#include "protocol/package/packed_face.h"
#include "protocol/package/render_mesh.h"

namespace semblante {
namespace {

constexpr std::uint32_t side = 9;  // vertices along one side of the test grid

/// A bumpy grid in xy with a UV seam along its middle column, a triangle that hangs on one of its edges as a third (not
/// manifold), a vertex no triangle uses, and a small loose triangle of another material.
Model make_model() {
  Model model;
  for (std::uint32_t y = 0; y < side; ++y) {
    for (std::uint32_t x = 0; x < side; ++x) {
      const auto fx = static_cast<float>(x);
      const auto fy = static_cast<float>(y);
      model.positions.emplace_back(fx, fy, std::sin(fx) * std::cos(fy));
      model.uvs.emplace_back(fx / 16.0F, fy / 16.0F);
    }
  }
  const auto at = [](std::uint32_t x, std::uint32_t y) { return y * side + x; };
  // The right half has its own UVs, so that the middle column is a seam.
  const auto right_uv = [&](std::uint32_t v) { return v + side * side; };
  for (std::uint32_t v = 0; v < side * side; ++v) model.uvs.push_back(model.uvs[v] + glm::vec2(0.5F, 0.5F));
  for (std::uint32_t y = 0; y + 1 < side; ++y) {
    for (std::uint32_t x = 0; x + 1 < side; ++x) {
      for (const Triangle& t :
           {Triangle{at(x, y), at(x + 1, y), at(x + 1, y + 1)}, Triangle{at(x, y), at(x + 1, y + 1), at(x, y + 1)}}) {
        model.triangles.push_back(t);
        const bool right = x >= side / 2;
        model.uv_triangles.push_back(right ? Triangle{right_uv(t[0]), right_uv(t[1]), right_uv(t[2])} : t);
      }
    }
  }
  model.positions.emplace_back(4.0F, 4.0F, 3.0F);  // the fin's tip
  const auto fin = static_cast<std::uint32_t>(model.positions.size() - 1);
  model.triangles.push_back({at(4, 4), at(5, 4), fin});
  model.uv_triangles.push_back({0, 1, 2});
  model.positions.emplace_back(100.0F, 100.0F, 100.0F);  // unused
  model.primitives.push_back({"skin", -1, 0, static_cast<std::uint32_t>(model.triangles.size())});
  const auto loose = static_cast<std::uint32_t>(model.positions.size());
  for (const float x : {0.0F, 1.0F, 2.0F}) model.positions.emplace_back(x, -3.0F, x * x);
  model.triangles.push_back({loose, loose + 1, loose + 2});
  model.uv_triangles.push_back({Model::no_index, Model::no_index, Model::no_index});
  Material green;
  green.name = "green";
  green.base_color = {0.1F, 0.5F, 0.1F, 1.0F};
  model.materials.push_back(green);
  model.primitives.push_back({"loose", 0, static_cast<std::uint32_t>(model.triangles.size() - 1), 1});
  model.images.push_back({"image/png", {1, 2, 3}});
  return model;
}

/// Influences that name their vertex: row of v is {fp v mod 5: 0.25 + v/1000, fp 5 + v mod 3: the rest to one}.
Rig make_rig(const Model& model) {
  Rig rig;
  for (std::uint32_t v = 0; v < model.positions.size(); ++v) {
    const float first = 0.25F + static_cast<float>(v) / 1000.0F;
    rig.influence.push(FeaturePointId(static_cast<std::uint8_t>(v % 5)), first);
    rig.influence.push(FeaturePointId(static_cast<std::uint8_t>(5 + v % 3)), 1.0F - first);
    rig.influence.end_row();
    rig.weights.end_row();
    rig.rigid_of_vertex.push_back(v % 7 == 0 ? RigidMotion::left_eye : RigidMotion::none);
    rig.part_of_vertex.emplace_back(0);
  }
  rig.points.push_back({*parse_feature_point("2.1"), VertexId(side + 2), model.positions[side + 2]});
  rig.points.push_back({*parse_feature_point("7.1"), std::nullopt, glm::vec3(4.0F)});
  rig.parts.push_back({"skin", PartRole::skin, false, 10, 10, {}, {}});
  rig.fapu.value[static_cast<std::size_t>(FapuUnit::mns)] = 0.001;
  return rig;
}

RenderMesh render(const Model& model, const Surface& surface) {
  return make_render_mesh(model, surface, assign_materials(model, surface, {}).of_triangle,
                          smooth_normals(model, surface));
}

TEST(RenderMesh, Corners_AtASeam_AreSplitOnce) {
  const Model model = make_model();
  const Surface surface = build_surface(model);
  const RenderMesh mesh = render(model, surface);
  // Each vertex once; the 9 of the seam column twice; the fin brings its tip and two corners with odd UVs; 3 loose.
  EXPECT_EQ(mesh.positions.size(), side * side + side + 3 + 3);
  ASSERT_EQ(mesh.triangles.size(), model.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(mesh.file_vertex[mesh.triangles[t][c]], model.triangles[t][c]);
  }
}

TEST(RenderMesh, Normals_WhenTheFileHasNone_AreUnitAndSharedAcrossTheSeam) {
  const Model model = make_model();
  const RenderMesh mesh = render(model, build_surface(model));
  std::map<std::uint32_t, glm::vec3> seen;
  for (std::size_t v = 0; v < mesh.normals.size(); ++v) {
    EXPECT_NEAR(glm::length(mesh.normals[v]), 1.0F, 1e-5F);
    const auto [at, added] = seen.emplace(mesh.file_vertex[v], mesh.normals[v]);
    EXPECT_EQ(at->second, mesh.normals[v]);
  }
}

TEST(Materials, BlankOnes_AreChosenByNameThenByRole) {
  Model model = make_model();
  model.primitives[0].name = "EyeLashes_left";
  const Surface surface = build_surface(model);
  EXPECT_EQ(assign_materials(model, surface, {}).materials[0].name, "lashes");
  model.primitives[0].name = "";
  std::vector<Part> parts(surface.part_count());
  EXPECT_EQ(assign_materials(model, surface, parts).materials[0].name, "skin");
  parts[0].role = PartRole::lower_teeth;
  const MaterialAssignment assigned = assign_materials(model, surface, parts);
  EXPECT_EQ(assigned.materials[0].name, "teeth");
  EXPECT_EQ(assigned.materials[assigned.of_triangle.back()].name, "green") << "what the file says is kept";
}

TEST(Materials, BlendedSkinTeethAndEyes_AreMasks_ButNotWhatIsSeenThrough) {
  using Mode = Material::AlphaMode;
  Model model = make_model();
  const Surface surface = build_surface(model);
  std::vector<Part> parts(surface.part_count());
  model.materials.push_back({});
  model.primitives[0].material = static_cast<int>(model.materials.size()) - 1;
  const auto look = [&](const char* name, PartRole role, float alpha, int image) {
    Material& material = model.materials.back();
    material.name = name;
    material.base_color = {0.8F, 0.5F, 0.4F, alpha};
    material.base_color_image = image;
    material.alpha_mode = Mode::blend;
    parts[0].role = role;
    return assign_materials(model, surface, parts).materials[0];
  };
  EXPECT_EQ(look("Material.001", PartRole::skin, 1.0F, 0).alpha_mode, Mode::mask);
  EXPECT_EQ(look("Material.001", PartRole::skin, 1.0F, -1).alpha_mode, Mode::opaque);
  EXPECT_EQ(look("Material.001", PartRole::skin, 0.0F, -1).base_color.a, 1.0F) << "opacity written as transparency";
  EXPECT_EQ(look("Material.001", PartRole::left_eye, 1.0F, 0).alpha_mode, Mode::mask);
  EXPECT_EQ(look("Material.001", PartRole::lower_teeth, 1.0F, 0).alpha_mode, Mode::mask);
  EXPECT_EQ(look("Material.001", PartRole::left_eye, 0.6F, 0).alpha_mode, Mode::blend) << "a film";
  EXPECT_EQ(look("Cornea", PartRole::left_eye, 1.0F, 0).alpha_mode, Mode::blend);
  EXPECT_EQ(look("Eyelashes", PartRole::skin, 1.0F, 0).alpha_mode, Mode::blend);
  EXPECT_EQ(look("Material.001", PartRole::attached, 1.0F, 0).alpha_mode, Mode::blend);
  EXPECT_EQ(look("Material.001", PartRole::rest, 1.0F, 0).alpha_mode, Mode::blend) << "glasses";
}

TEST(Materials, OneBlendedMaterialOfSkinAndLashes_IsTwo) {
  Model model = make_model();
  const Surface surface = build_surface(model);
  std::vector<Part> parts(surface.part_count());
  ASSERT_GT(parts.size(), 1U);
  for (Part& part : parts) part.role = PartRole::attached;
  parts[0].role = PartRole::skin;
  Material atlas;
  atlas.base_color_image = 0;
  atlas.alpha_mode = Material::AlphaMode::blend;
  model.materials.assign(1, atlas);
  for (Primitive& primitive : model.primitives) primitive.material = 0;
  const MaterialAssignment assigned = assign_materials(model, surface, parts);
  ASSERT_EQ(assigned.materials.size(), 2U);
  for (std::size_t t = 0; t < model.triangles.size(); ++t) {
    const bool is_skin = surface.part_of[surface.surface_of[model.triangles[t][0]].value()] == PartId(0);
    EXPECT_EQ(assigned.materials[assigned.of_triangle[t]].alpha_mode,
              is_skin ? Material::AlphaMode::mask : Material::AlphaMode::blend);
  }
}

TEST(Materials, AColourThatIsLost_IsThatOfTheRole_AndClothNeverLooksLikeSkin) {
  Model model = make_model();
  const Surface surface = build_surface(model);
  std::vector<Part> parts(surface.part_count());
  model.materials.push_back({});
  model.primitives[0].material = static_cast<int>(model.materials.size()) - 1;
  const auto look = [&](const char* name, PartRole role, bool is_lost) {
    Material& material = model.materials.back();
    material.name = name;
    material.base_color = {0.9F, 0.9F, 0.8F, 1.0F};  // the factor of the image that is lost
    material.is_color_lost = is_lost;
    parts[0].role = role;
    return assign_materials(model, surface, parts).materials[0].name;
  };
  EXPECT_EQ(look("Wolf3D_Outfit_Top", PartRole::rest, true), "neutral");
  EXPECT_EQ(look("Wolf3D_Outfit_Top", PartRole::rest, false), "Wolf3D_Outfit_Top");
  EXPECT_EQ(look("Material.004", PartRole::rest, true), "neutral");
  EXPECT_EQ(look("Wolf3D_Skin", PartRole::skin, true), "skin");
  EXPECT_EQ(look("N00_000_00_Body_00_SKIN", PartRole::rest, true), "skin");
  EXPECT_EQ(look("Wolf3D_Hair", PartRole::rest, true), "hair");
  EXPECT_EQ(look("Material.005", PartRole::upper_teeth, true), "teeth");
  EXPECT_EQ(look("Skin", PartRole::left_eye, true), "sclera");
  EXPECT_EQ(look("N00_000_00_FaceEyeline_00_FACE", PartRole::attached, true), "lashes");
}

/// The grid with colours of its first part, all but its unused vertex and the loose triangle.
Model make_colored_model() {
  Model model = make_model();
  model.colors.assign(model.positions.size(), white);
  for (std::uint32_t v = 0; v <= side * side; ++v) {
    const auto level = static_cast<std::uint8_t>(v);
    model.colors[v] = {level, 100, static_cast<std::uint8_t>(255 - level)};
  }
  model.primitives[0].triangle_count -= 1;  // to the loose triangle, which is the other's
  model.primitives[0].has_colors = true;
  return model;
}

TEST(Materials, OfVerticesWithColors_AreWhite_UnlessTheFileHasAnother) {
  Model model = make_colored_model();
  const Surface surface = build_surface(model);
  const MaterialAssignment assigned = assign_materials(model, surface, {});
  ASSERT_EQ(assigned.materials.size(), 2U);
  EXPECT_EQ(assigned.materials[0].name, "skin") << "tells viewers what surface it is";
  EXPECT_EQ(assigned.materials[0].base_color, glm::vec4(1.0F));
  EXPECT_EQ(assigned.materials[1].name, "green");
  model.primitives[0].material = 0;
  EXPECT_EQ(assign_materials(model, surface, {}).materials.size(), 1U) << "colours multiply the file's material";
  model.primitives[0].material = -1;
  model.primitives[0].name = "EyeOcclusion";
  EXPECT_LT(assign_materials(model, surface, {}).materials[0].base_color.a, 0.1F) << "still a film";
}

TEST(EncodeMesh, Colors_AreExact_AndWithoutThemNothingChanges) {
  const Model model = make_colored_model();
  const auto encoded = encode_mesh(render(model, build_surface(model)));
  ASSERT_TRUE(encoded.ok()) << encoded.error().message;
  ASSERT_TRUE(encoded->attributes.color);
  const auto decoded = DracoMesh::decode(encoded->bytes);
  ASSERT_TRUE(decoded.ok());
  const auto colors = decoded->colors(*encoded->attributes.color);
  ASSERT_TRUE(colors.ok()) << colors.error().message;
  ASSERT_EQ(colors->size(), encoded->file_vertex.size());
  for (std::size_t v = 0; v < colors->size(); ++v) EXPECT_EQ((*colors)[v], model.colors[encoded->file_vertex[v]]);
  EXPECT_FALSE(decoded->colors(encoded->attributes.normal).ok()) << "floats are no bytes";
  EXPECT_FALSE(decoded->colors(encoded->attributes.material).ok()) << "one component";

  Model plain = model;
  plain.colors.clear();
  EXPECT_FALSE(encode_mesh(render(plain, build_surface(plain)))->attributes.color);
}

TEST(Package, Colors_AreInAllFiles_AndOnlyThen) {
  const Model model = make_colored_model();
  const Surface surface = build_surface(model);
  const Rig rig = make_rig(model);
  const auto package = build_package(model, surface, rig, {"Grid", 12, {}, {}});
  ASSERT_TRUE(package.ok()) << package.error().message;
  const auto text = [](const Artefact& artefact) { return std::string(artefact.bytes.begin(), artefact.bytes.end()); };
  const std::string rig_json = text(package->rig_json);
  EXPECT_NE(rig_json.find("\"color\":"), std::string::npos);
  const auto face =
      open_package({package->mesh_drc.bytes, package->weights.bytes, rig_json,
                    [&](const Sha256&) -> Result<std::vector<std::uint8_t>> { return model.images[0].bytes; }});
  ASSERT_TRUE(face.ok()) << face.error().where << face.error().message;
  EXPECT_EQ(face->mesh.colors.size(), face->mesh.positions.size());
  EXPECT_THAT(face->mesh.colors, testing::Contains(model.colors[0]));

  const auto preview = build_preview(model, surface, {});
  ASSERT_TRUE(preview.ok());
  const auto count_in = [](const std::string& glb) {
    std::size_t count = 0;
    for (std::size_t at = glb.find("COLOR_0"); at != std::string::npos; at = glb.find("COLOR_0", at + 1)) ++count;
    return count;
  };
  EXPECT_EQ(count_in({preview->begin(), preview->end()}), 1U) << "of the part with colours only";
  EXPECT_EQ(count_in(text(package->face_glb)), 2U) << "as an attribute, and as one of its Draco data";
  Model plain = model;
  plain.colors.clear();
  const auto without = build_package(plain, surface, rig, {"Grid", 12, {}, {}});
  EXPECT_EQ(text(without->rig_json).find("\"color\":"), std::string::npos);
}

TEST(EncodeMesh, DecodedOrder_NamesTheFileVertexOfEveryPosition) {
  const Model model = make_model();
  const RenderMesh mesh = render(model, build_surface(model));
  const auto encoded = encode_mesh(mesh);
  ASSERT_TRUE(encoded.ok()) << encoded.error().message;
  const auto decoded = DracoMesh::decode(encoded->bytes);
  ASSERT_TRUE(decoded.ok());
  const auto positions = decoded->vectors3(encoded->attributes.position);
  ASSERT_TRUE(positions.ok());
  ASSERT_EQ(decoded->point_count(), encoded->file_vertex.size());
  for (std::size_t v = 0; v < decoded->point_count(); ++v) {
    for (int c = 0; c < 3; ++c) {
      // 14 bits over a side of 11: half a step is 0.0003.
      EXPECT_NEAR((*positions)[v][c], model.positions[encoded->file_vertex[v]][c], 5e-4);
    }
  }
  EXPECT_THAT(encoded->file_vertex, testing::Not(testing::Contains(side * side + 1))) << "the unused vertex is dropped";
}

TEST(Package, VertexLeftFarAway_DoesNotCoarsenTheFace) {
  Model model = make_model();
  constexpr double es_unit = 2.0 / 1024.0;
  model.positions[0].x = -5000.0F;
  const Surface surface = build_surface(model);
  Rig rig = make_rig(model);
  rig.fapu.value[static_cast<std::size_t>(FapuUnit::es)] = es_unit;
  const auto package = build_package(model, surface, rig, {"Grid", 12, {}, {}});
  ASSERT_TRUE(package.ok()) << package.error().message;
  const auto decoded = DracoMesh::decode(package->mesh_drc.bytes);
  ASSERT_TRUE(decoded.ok());
  const auto positions = decoded->vectors3(0);
  ASSERT_TRUE(positions.ok());
  for (const glm::vec3& position : *positions) {
    float nearest = std::numeric_limits<float>::max();
    for (const glm::vec3& original : model.positions) nearest = std::min(nearest, glm::distance(position, original));
    EXPECT_LE(nearest, 2.0 * es_unit) << "half a step of two units, on each of three axes";
  }
}

TEST(EncodeMesh, NoTriangles_IsRefused) {
  const auto encoded = encode_mesh(RenderMesh{});
  ASSERT_FALSE(encoded.ok());
  EXPECT_EQ(encoded.error().code, ErrorCode::empty);
}

class PackageOfAGrid : public testing::Test {
 protected:
  void SetUp() override {
    auto built = build_package(model_, surface_, rig_, {"Grid", 12, {}, {"a warning"}});
    ASSERT_TRUE(built.ok()) << built.error().where << ": " << built.error().message;
    package_ = std::move(*built);
    auto rig =
        read_rig({reinterpret_cast<const char*>(package_.rig_json.bytes.data()), package_.rig_json.bytes.size()});
    ASSERT_TRUE(rig.ok()) << rig.error().where << ": " << rig.error().message;
    document_ = std::move(*rig);
  }

  Model model_ = make_model();
  Surface surface_ = build_surface(model_);
  Rig rig_ = make_rig(model_);
  FacePackage package_;
  RigDocument document_;
};

TEST_F(PackageOfAGrid, Hashes_AreOfTheBytesAndBindTheThreeTogether) {
  EXPECT_EQ(package_.mesh_drc.sha256, sha256(package_.mesh_drc.bytes));
  EXPECT_EQ(document_.mesh.sha256, package_.mesh_drc.sha256);
  EXPECT_EQ(document_.weights.sha256, package_.weights.sha256);
  const auto table = decode_weights(package_.weights.bytes);
  ASSERT_TRUE(table.ok());
  EXPECT_EQ(table->mesh_sha256, package_.mesh_drc.sha256);
}

TEST_F(PackageOfAGrid, Rows_FollowTheDecodedOrder) {
  const auto table = decode_weights(package_.weights.bytes);
  const auto mesh = encode_mesh(render(model_, surface_));
  ASSERT_TRUE(table.ok() && mesh.ok());
  ASSERT_EQ(table->vertex_count, mesh->file_vertex.size());
  for (std::size_t v = 0; v < mesh->file_vertex.size(); ++v) {
    const std::uint32_t file = mesh->file_vertex[v];
    ASSERT_EQ(table->rows.points_of(v).size(), 2U);
    EXPECT_EQ(table->rows.points_of(v)[0].value(), file % 5);
    EXPECT_NEAR(table->rows.weights_of(v)[0], 0.25 + file / 1000.0, document_.weights.max_error + 1e-7);
    EXPECT_EQ(table->rigid[v], file % 7 == 0 ? 1 : 0);
  }
  EXPECT_LE(document_.weights.max_error, 1.0 / 4095) << "12 bits";
}

TEST_F(PackageOfAGrid, FeaturePoints_PointAtTheirDecodedVertex) {
  const auto mesh = encode_mesh(render(model_, surface_));
  ASSERT_EQ(document_.feature_points.size(), 2U);
  ASSERT_TRUE(document_.feature_points[0].vertex.has_value());
  EXPECT_EQ(mesh->file_vertex[*document_.feature_points[0].vertex], side + 2);
  EXPECT_FALSE(document_.feature_points[1].vertex.has_value()) << "7.1 is a bare position";
}

TEST_F(PackageOfAGrid, Rig_ListsMaterialsImagesAndOnlyMovesMarkedPoints) {
  EXPECT_EQ(document_.name, "Grid");
  ASSERT_EQ(document_.images.size(), 1U);
  EXPECT_EQ(document_.images[0].sha256, sha256(model_.images[0].bytes));
  EXPECT_EQ(document_.materials.size(), 2U);
  EXPECT_THAT(document_.warnings, testing::Contains("a warning"));
  for (const auto& set : document_.visemes) {
    for (const auto& displacement : set.displacements) EXPECT_EQ(to_string(displacement.id), "2.1");
  }
}

TEST_F(PackageOfAGrid, Building_Twice_GivesTheSameBytes) {
  const auto again = build_package(model_, surface_, rig_, {"Grid", 12, {}, {"a warning"}});
  ASSERT_TRUE(again.ok());
  EXPECT_EQ(again->mesh_drc.bytes, package_.mesh_drc.bytes);
  EXPECT_EQ(again->weights.bytes, package_.weights.bytes);
  EXPECT_EQ(again->rig_json.bytes, package_.rig_json.bytes);
  EXPECT_EQ(again->face_glb.bytes, package_.face_glb.bytes);
}

}  // namespace
}  // namespace semblante
