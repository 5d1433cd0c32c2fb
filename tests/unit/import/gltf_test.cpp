#include <cstring>
#include <limits>

#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <gtest/gtest.h>

#include "tests/unit/import/gltf_writer.h"
#include "tests/unit/import/test_files.h"

namespace semblante::test {
namespace {

Result<Model> import_json(std::string_view json, const ImportLimits& limits = {}) {
  return import_model(make_glb(json, quad_gltf_binary()), ModelFormat::glb, limits);
}

/// quad_gltf_json() with one change must be refused with this code at this pointer.
struct InvalidGltfFile {
  const char* name;
  const char* what;
  const char* with;
  ErrorCode code;
  const char* where;
};
void PrintTo(const InvalidGltfFile& invalid, std::ostream* out) { *out << invalid.name; }

class InvalidGltf : public ::testing::TestWithParam<InvalidGltfFile> {};

TEST_P(InvalidGltf, IsRefused_NamingTheMember) {
  const auto model = import_json(replaced(quad_gltf_json(), GetParam().what, GetParam().with));
  ASSERT_FALSE(model);
  EXPECT_EQ(static_cast<int>(model.error().code), static_cast<int>(GetParam().code)) << model.error().message;
  EXPECT_EQ(model.error().where, GetParam().where) << model.error().message;
}

const InvalidGltfFile invalid_gltfs[] = {
    {"NoAsset", R"("asset":{"version":"2.0"},)", "", ErrorCode::missing, "/asset"},
    {"VersionOne", R"("version":"2.0")", R"("version":"1.0")", ErrorCode::unsupported, "/asset/version"},
    {"VersionIsANumber", R"("version":"2.0")", R"("version":2)", ErrorCode::malformed, "/asset/version"},
    {"UnknownExtensionRequired", R"("scene":0,)", R"("scene":0,"extensionsRequired":["X_secret"],)",
     ErrorCode::unsupported, "/extensionsRequired/0"},
    {"SceneOutOfRange", R"("scene":0,)", R"("scene":1,)", ErrorCode::out_of_range, "/scene"},
    {"SceneNodeOutOfRange", R"([{"nodes":[0]}])", R"([{"nodes":[1]}])", ErrorCode::out_of_range, "/scenes/0/nodes/0"},
    {"SceneIsANumber", R"([{"nodes":[0]}])", "[7]", ErrorCode::malformed, "/scenes/0"},
    {"NodeIsANumber", R"([{"mesh":0}])", "[7]", ErrorCode::malformed, "/nodes/0"},
    {"NodeIsNull", R"([{"mesh":0}])", "[null]", ErrorCode::malformed, "/nodes/0"},
    {"NodeTwice", R"([{"nodes":[0]}])", R"([{"nodes":[0,0]}])", ErrorCode::malformed, "/nodes/0"},
    {"NodeLoop", R"([{"mesh":0}])", R"([{"mesh":0,"children":[0]}])", ErrorCode::malformed, "/nodes/0"},
    {"NodeMeshOutOfRange", R"([{"mesh":0}])", R"([{"mesh":1}])", ErrorCode::out_of_range, "/nodes/0/mesh"},
    {"NodeMatrixTooShort", R"([{"mesh":0}])", R"([{"mesh":0,"matrix":[1,0,0]}])", ErrorCode::malformed,
     "/nodes/0/matrix"},
    {"NodeScaleIsText", R"([{"mesh":0}])", R"([{"mesh":0,"scale":[1,"1",1]}])", ErrorCode::malformed,
     "/nodes/0/scale/1"},
    {"NodeRotationIsZero", R"([{"mesh":0}])", R"([{"mesh":0,"rotation":[0,0,0,0]}])", ErrorCode::invalid_argument,
     "/nodes/0/rotation"},
    {"NodeScaleOverflows", R"([{"mesh":0}])", R"([{"mesh":0,"scale":[1e300,1,1]}])", ErrorCode::not_finite, "vertex 1"},
    {"NodeScaleFlattens", R"([{"mesh":0}])", R"([{"mesh":0,"scale":[0,0,0]}])", ErrorCode::empty, ""},
    {"MeshWithoutPrimitives", R"("primitives":)", R"("primitive":)", ErrorCode::missing, "/meshes/0/primitives"},
    {"AttributesMissing", R"("attributes":)", R"("attribute":)", ErrorCode::missing,
     "/meshes/0/primitives/0/attributes"},
    {"PositionOutOfRange", R"("POSITION":0)", R"("POSITION":3)", ErrorCode::out_of_range,
     "/meshes/0/primitives/0/attributes/POSITION"},
    {"PositionNegative", R"("POSITION":0)", R"("POSITION":-1)", ErrorCode::out_of_range,
     "/meshes/0/primitives/0/attributes/POSITION"},
    {"PositionIsText", R"("POSITION":0)", R"("POSITION":"0")", ErrorCode::malformed,
     "/meshes/0/primitives/0/attributes/POSITION"},
    {"PositionIsVec2", R"("POSITION":0)", R"("POSITION":1)", ErrorCode::malformed, "/accessors/1/type"},
    {"NoPositions", R"("POSITION":0)", R"("_POSITION":0)", ErrorCode::empty, ""},
    {"IndicesOutOfRange", R"("indices":2)", R"("indices":7)", ErrorCode::out_of_range,
     "/meshes/0/primitives/0/indices"},
    {"IndicesAreFloats", R"("indices":2)", R"("indices":0)", ErrorCode::malformed, "/accessors/0/componentType"},
    {"MaterialOutOfRange", R"("material":0)", R"("material":1)", ErrorCode::out_of_range,
     "/meshes/0/primitives/0/material"},
    {"ModeUnknown", R"("material":0)", R"("mode":7)", ErrorCode::out_of_range, "/meshes/0/primitives/0/mode"},
    {"OnlyPoints", R"("material":0)", R"("mode":0)", ErrorCode::empty, ""},
    {"ColorOfThree", "[0.5,0.25,0.125,1]", "[1,1,1]", ErrorCode::malformed,
     "/materials/0/pbrMetallicRoughness/baseColorFactor"},
    {"CountTooLarge", R"("count":4,"type":"VEC3")", R"("count":5,"type":"VEC3")", ErrorCode::out_of_range,
     "/accessors/0"},
    {"CountOfTwoGigabytes", R"("count":4,"type":"VEC3")", R"("count":178956970,"type":"VEC3")", ErrorCode::too_large,
     "/accessors/0/count"},
    {"CountOverflows64Bits", R"("count":4,"type":"VEC3")", R"("count":1537228672809129302,"type":"VEC3")",
     ErrorCode::too_large, "/accessors/0/count"},
    {"CountBeyond64Bits", R"("count":4,"type":"VEC3")", R"("count":99999999999999999999,"type":"VEC3")",
     ErrorCode::out_of_range, "/accessors/0/count"},
    {"CountNegative", R"("count":4,"type":"VEC3")", R"("count":-4,"type":"VEC3")", ErrorCode::out_of_range,
     "/accessors/0/count"},
    {"UvCountDiffers", R"("count":4,"type":"VEC2")", R"("count":3,"type":"VEC2")", ErrorCode::mismatch,
     "/accessors/1/count"},
    {"ComponentTypeUnknown", R"(5126,"count":4,"type":"VEC3")", R"(5124,"count":4,"type":"VEC3")", ErrorCode::malformed,
     "/accessors/0/componentType"},
    {"TypeUnknown", R"("type":"VEC3")", R"("type":"VEC7")", ErrorCode::malformed, "/accessors/0/type"},
    {"ViewMissing", R"("bufferView":2)", R"("bufferView":3)", ErrorCode::out_of_range, "/accessors/2/bufferView"},
    {"ViewTooLong", R"("byteOffset":80,"byteLength":12)", R"("byteOffset":80,"byteLength":13)", ErrorCode::out_of_range,
     "/bufferViews/2"},
    {"ViewOffsetBeyondBuffer", R"("byteOffset":80,"byteLength":12)", R"("byteOffset":8000000000,"byteLength":0)",
     ErrorCode::out_of_range, "/bufferViews/2"},
    {"ViewOffsetNegative", R"("byteOffset":80)", R"("byteOffset":-80)", ErrorCode::out_of_range,
     "/bufferViews/2/byteOffset"},
    {"ViewWithoutLength", R"(,"byteOffset":48,"byteLength":32)", "", ErrorCode::missing, "/bufferViews/1/byteLength"},
    {"StrideTooSmall", R"("byteLength":48)", R"("byteLength":48,"byteStride":8)", ErrorCode::out_of_range,
     "/bufferViews/0/byteStride"},
    {"StrideTooLarge", R"("byteLength":48)", R"("byteLength":48,"byteStride":16)", ErrorCode::out_of_range,
     "/accessors/0"},
    {"StrideHuge", R"("byteLength":48)", R"("byteLength":48,"byteStride":1099511627776)", ErrorCode::out_of_range,
     "/bufferViews/0/byteStride"},
    {"AccessorOffsetTooLarge", R"("bufferView":0)", R"("bufferView":0,"byteOffset":4)", ErrorCode::out_of_range,
     "/accessors/0"},
    {"MeshoptWithoutAnything", R"("byteLength":48)", R"("byteLength":48,"extensions":{"EXT_meshopt_compression":{}})",
     ErrorCode::missing, "/bufferViews/0/extensions/EXT_meshopt_compression/count"},
    {"BufferTooLong", R"([{"byteLength":92}])", R"([{"byteLength":93}])", ErrorCode::truncated,
     "/buffers/0/byteLength"},
    {"BufferOfTwoGigabytes", R"([{"byteLength":92}])", R"([{"byteLength":2147483648}])", ErrorCode::truncated,
     "/buffers/0/byteLength"},
    {"BufferOnDisk", R"([{"byteLength":92}])", R"([{"byteLength":92,"uri":"../../etc/passwd"}])",
     ErrorCode::unsupported, "/buffers/0/uri"},
    {"BufferOnTheNet", R"([{"byteLength":92}])", R"([{"byteLength":92,"uri":"http://example.org/a.bin"}])",
     ErrorCode::unsupported, "/buffers/0/uri"},
    {"BufferIsBadBase64", R"([{"byteLength":92}])", R"([{"byteLength":92,"uri":"data:;base64,!!!!"}])",
     ErrorCode::malformed, "/buffers/0/uri"},
    {"MemberTwice", R"("scene":0,)", R"("scene":0,"scene":0,)", ErrorCode::malformed, "/scene"},
    {"SparseOutOfRange", R"("bufferView":0,)",
     R"("sparse":{"count":1,"indices":{"bufferView":2,"byteOffset":10,"componentType":5121},"values":{"bufferView":0}},)",
     ErrorCode::empty, ""},
    {"SparseIndexTooLarge", R"("bufferView":0,)",
     R"("sparse":{"count":1,"indices":{"bufferView":0,"byteOffset":12,"componentType":5125},"values":{"bufferView":0}},)",
     ErrorCode::out_of_range, "/accessors/0/sparse/indices"},
    {"SparseCountTooLarge", R"("bufferView":0,)",
     R"("sparse":{"count":5,"indices":{"bufferView":2,"componentType":5121},"values":{"bufferView":0}},)",
     ErrorCode::out_of_range, "/accessors/0/sparse/count"},
    {"SparseValuesTooShort", R"("bufferView":0,)",
     R"("sparse":{"count":3,"indices":{"bufferView":2,"componentType":5123},"values":{"bufferView":1}},)",
     ErrorCode::out_of_range, "/accessors/0/sparse/values"},
};

INSTANTIATE_TEST_SUITE_P(Gltf, InvalidGltf, ::testing::ValuesIn(invalid_gltfs),
                         [](const auto& test) { return test.param.name; });

/// Faults of the container: bytes of quad_glb() changed.
TEST(Glb, InvalidContainers_AreRefused_NamingTheByte) {
  const auto expect_refused = [](const char* name, const Bytes& bytes, ErrorCode code, const char* where) {
    const auto model = import_model(bytes, ModelFormat::glb);
    ASSERT_FALSE(model) << name;
    EXPECT_EQ(static_cast<int>(model.error().code), static_cast<int>(code)) << name << ": " << model.error().message;
    EXPECT_EQ(model.error().where, where) << name << ": " << model.error().message;
  };
  const auto put = [](Bytes bytes, std::size_t at, std::uint32_t value) {
    std::memcpy(bytes.data() + at, &value, sizeof value);
    return bytes;
  };
  const Bytes good = quad_glb();
  std::uint32_t json_size = 0;
  std::memcpy(&json_size, good.data() + 12, 4);
  const std::size_t binary_at = 20 + json_size;
  expect_refused("magic", put(good, 0, 0x46546C68), ErrorCode::malformed, "byte 0");
  expect_refused("version 1", put(good, 4, 1), ErrorCode::unsupported, "byte 4");
  expect_refused("length too large", put(good, 8, 0x7FFFFFFF), ErrorCode::truncated, "byte 8");
  expect_refused("length 4 GB", put(good, 8, 0xFFFFFFFF), ErrorCode::truncated, "byte 8");
  expect_refused("length without chunk", put(good, 8, 12), ErrorCode::truncated, "byte 8");
  expect_refused("length within header", put(good, 8, 3), ErrorCode::truncated, "byte 8");
  expect_refused("JSON chunk of 2 GB", put(good, 12, 0x7FFFFFF0), ErrorCode::truncated, "byte 12");
  expect_refused("first chunk is not JSON", put(good, 16, 0x004E4942), ErrorCode::malformed, "byte 16");
  expect_refused("binary chunk of 4 GB", put(good, binary_at, 0xFFFFFFFC), ErrorCode::truncated,
                 ("byte " + std::to_string(binary_at)).c_str());
  expect_refused("header alone", Bytes(good.begin(), good.begin() + 11), ErrorCode::truncated, "byte 11");
  expect_refused("no binary chunk", make_glb(quad_gltf_json(), {}), ErrorCode::truncated, "/buffers/0/byteLength");
  expect_refused("JSON is an array", make_glb("[1, 2]", {}), ErrorCode::malformed, "");
  std::string zeros;
  for (int i = 0; i < 63; ++i) zeros += "/0";
  expect_refused("JSON is nested a million deep",
                 make_glb(R"({"asset":{"version":"2.0"},"x":)" + std::string(1'000'000, '['), {}), ErrorCode::too_large,
                 ("/x" + zeros).c_str());
}

TEST(Gltf, Positions_ThatAreNotFinite_AreRefused) {
  for (const std::uint32_t bits : {0x7FC00000U, 0x7F800000U, 0xFF800000U}) {
    Bytes binary = quad_gltf_binary();
    std::memcpy(binary.data() + 12, &bits, sizeof bits);
    const auto model = import_model(make_glb(quad_gltf_json(), binary), ModelFormat::glb);
    ASSERT_FALSE(model);
    EXPECT_EQ(static_cast<int>(model.error().code), static_cast<int>(ErrorCode::not_finite));
    EXPECT_EQ(model.error().where, "/accessors/0");
  }
}

TEST(Gltf, Index_OutOfRange_IsRefused_WithItsPlace) {
  Bytes binary = quad_gltf_binary();
  binary[80 + 2 * 4] = 4;  // the fifth index, 2, becomes 4: one past the end
  const auto model = import_model(make_glb(quad_gltf_json(), binary), ModelFormat::glb);
  ASSERT_FALSE(model);
  EXPECT_EQ(static_cast<int>(model.error().code), static_cast<int>(ErrorCode::out_of_range));
  EXPECT_EQ(model.error().where, "/accessors/2");
  EXPECT_NE(model.error().message.find("element 4 refers to vertex 4, but there are 4"), std::string::npos)
      << model.error().message;
}

TEST(Gltf, Quad_ComesOutAsWritten) {
  const auto model = import_json(quad_gltf_json());
  ASSERT_TRUE(model) << model.error().message;
  EXPECT_EQ(model->positions[2], glm::vec3(1, 1, 0));
  EXPECT_EQ(model->triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(model->uv_triangles, model->triangles);
  EXPECT_EQ(model->uvs[3], glm::vec2(0, 0));
  EXPECT_TRUE(model->normals.empty());
  ASSERT_EQ(model->materials.size(), 1U);
  EXPECT_EQ(model->materials[0].name, "skin");
  EXPECT_EQ(model->materials[0].base_color, glm::vec4(0.5F, 0.25F, 0.125F, 1.0F));
  EXPECT_EQ(model->primitives[0].name, "quad");
  EXPECT_TRUE(model->warnings.empty());
  EXPECT_EQ(model->format, "glb");
}

TEST(Gltf, BufferInADataUri_IsReadLikeAChunk) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const Bytes binary = quad_gltf_binary();
  std::string base64;
  for (std::size_t i = 0; i < binary.size(); i += 3) {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k) bits = bits << 8 | (i + k < binary.size() ? binary[i + k] : 0U);
    for (std::size_t k = 0; k < 4; ++k) base64 += i + k > binary.size() ? '=' : digits[bits >> (18 - 6 * k) & 63U];
  }
  const std::string json =
      replaced(quad_gltf_json(), R"({"byteLength":92})",
               R"({"byteLength":92,"uri":"data:application/octet-stream;base64,)" + base64 + "\"}");
  const auto model = import_model(to_bytes(json), ModelFormat::gltf);
  ASSERT_TRUE(model) << model.error().where << model.error().message;
  EXPECT_EQ(model->positions[2], glm::vec3(1, 1, 0));
  EXPECT_EQ(model->format, "gltf");
}

TEST(Gltf, Strip_AlternatesItsWinding) {
  // Indices 0 1 2 0 2 3 as a strip: (0 1 2) (1 0 2)->(2 1 0)... by the rule of glTF: p_i = {i, i + 1 + i%2, i + 2 -
  // i%2}: (0 1 2), (1 0 2), (2 0 2) degenerate, (0 3 2).
  const auto model = import_json(replaced(quad_gltf_json(), R"("material":0)", R"("mode":5)"));
  ASSERT_TRUE(model) << model.error().message;
  EXPECT_EQ(model->triangles, (std::vector<Triangle>{{0, 1, 2}, {1, 0, 2}, {0, 3, 2}}));
}

TEST(Gltf, Fan_TurnsAboutItsFirstVertex) {
  // Without indices: 0 1 2 3 as a fan is (1 2 0) (2 3 0).
  const auto model = import_json(replaced(quad_gltf_json(), R"("indices":2,"material":0)", R"("mode":6)"));
  ASSERT_TRUE(model) << model.error().message;
  EXPECT_EQ(model->triangles, (std::vector<Triangle>{{1, 2, 0}, {2, 3, 0}}));
}

TEST(Gltf, Nodes_MoveTheirMeshes_ParentFirst) {
  // Parent: two to the right. Child: a quarter turn about z, then double size. (1, 0, 0) -> (2,0,0) -> (0,2,0) ->
  // (2,2,0).
  const std::string nodes = R"([{"translation":[2,0,0],"children":[1]},
      {"mesh":0,"rotation":[0,0,0.7071067811865476,0.7071067811865476],"scale":[2,2,2]}])";
  const auto model = import_json(replaced(quad_gltf_json(), R"([{"mesh":0}])", nodes));
  ASSERT_TRUE(model) << model.error().message;
  EXPECT_NEAR(model->positions[1].x, 2.0F, 1e-6F);
  EXPECT_NEAR(model->positions[1].y, 2.0F, 1e-6F);
}

TEST(Gltf, MirroringNode_KeepsTheOutsideOut) {
  const auto model = import_json(
      replaced(quad_gltf_json(), R"([{"mesh":0}])", R"([{"mesh":0,"matrix":[-1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]}])"));
  ASSERT_TRUE(model) << model.error().message;
  EXPECT_EQ(model->triangles[0], (Triangle{0, 2, 1}));
  EXPECT_EQ(model->positions[1], glm::vec3(-1, 0, 0));
}

/// The quad with two joints: nodes 1 and 2, at rest where `translations` say; vertices 0 and 1 follow the first, 2 and
/// 3 the second. Both were bound at the origin. The mesh's own node is far off, which a skin ignores.
Result<Model> skinned_quad(const std::string& first, const std::string& second) {
  Packer binary;
  binary.bytes = quad_gltf_binary();  // 92 bytes
  for (const int joint : {0, 0, 1, 1}) {
    binary.put(static_cast<std::uint8_t>(joint));
    for (int i = 0; i < 3; ++i) binary.put(std::uint8_t{0});
  }
  for (int vertex = 0; vertex < 4; ++vertex) binary.put(1.0F).put(0.0F).put(0.0F).put(0.0F);
  std::string json = replaced(quad_gltf_json(), R"([{"mesh":0}])",
                              R"([{"mesh":0,"skin":0,"translation":[50,0,0]},{"translation":)" + first +
                                  R"(},{"translation":)" + second + "}]");
  json = replaced(json, R"([{"nodes":[0]}])", R"([{"nodes":[0,1,2]}])");
  json = replaced(json, R"("TEXCOORD_0":1)", R"("TEXCOORD_0":1,"JOINTS_0":3,"WEIGHTS_0":4)");
  json = replaced(json, R"("count":6,"type":"SCALAR"})",
                  R"("count":6,"type":"SCALAR"},{"bufferView":3,"componentType":5121,"count":4,"type":"VEC4"},
{"bufferView":4,"componentType":5126,"count":4,"type":"VEC4"})");
  json = replaced(json, R"("byteOffset":80,"byteLength":12})",
                  R"("byteOffset":80,"byteLength":12},{"buffer":0,"byteOffset":92,"byteLength":16},
{"buffer":0,"byteOffset":108,"byteLength":64})");
  json = replaced(json, R"([{"byteLength":92}])", R"([{"byteLength":172}],"skins":[{"joints":[1,2]}])");
  return import_model(make_glb(json, binary.bytes), ModelFormat::glb);
}

TEST(Gltf, Skin_PutsVerticesWhereTheirJointsAre) {
  const auto model = skinned_quad("[0,0,1]", "[0,2,0]");
  ASSERT_TRUE(model) << model.error().where << model.error().message;
  EXPECT_EQ(model->positions, (std::vector<glm::vec3>{{0, 0, 1}, {1, 0, 1}, {1, 3, 0}, {0, 3, 0}}));
}

TEST(Gltf, Skin_InItsBindPose_LeavesEveryBit) {
  const auto model = skinned_quad("[0,0,0]", "[0,0,0]");
  ASSERT_TRUE(model) << model.error().where << model.error().message;
  EXPECT_EQ(model->positions, (std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
}

/// A quad as the face, and a smaller one that nodes of their own show as its eyes.
GltfWriter face_with_eyes(const nlohmann::json& eyes) {
  GltfWriter writer;
  auto& json = writer.json;
  json["meshes"] = nlohmann::json::array();
  for (const float size : {0.25F, 8.0F}) {
    nlohmann::json primitive = {{"attributes", nlohmann::json::object()}};
    primitive["attributes"]["POSITION"] = writer.floats({0, 0, 0, size, 0, 0, size, size, 0, 0, size, 0}, "VEC3");
    primitive["indices"] = writer.indices({0, 1, 2, 0, 2, 3});
    json["meshes"].push_back({{"primitives", {primitive}}});
  }
  json["nodes"] = {{{"mesh", 1}}};
  json["scenes"][0]["nodes"] = {0};
  for (const auto& eye : eyes) {
    json["scenes"][0]["nodes"].push_back(json["nodes"].size());
    json["nodes"].push_back(eye);
  }
  return writer;
}

nlohmann::json eye_at(double x) { return {{"mesh", 0}, {"translation", {x, 4, 0}}}; }

TEST(Gltf, MeshInTwoNodes_StandsInBoth_AfterTheVerticesOfAllMeshes) {
  const auto model =
      face_with_eyes({eye_at(2), {{"mesh", 0}, {"translation", {6, 4, 0}}, {"scale", {-1, 1, 1}}}}).import();
  ASSERT_TRUE(model) << model.error().message;
  ASSERT_EQ(model->positions.size(), 12U);
  EXPECT_EQ(model->positions[0], glm::vec3(2, 4, 0)) << "the first place has the numbers of the file";
  EXPECT_EQ(model->positions[6], glm::vec3(8, 8, 0)) << "the face";
  EXPECT_EQ(model->positions[9], glm::vec3(5.75F, 4, 0)) << "the second, mirrored";
  EXPECT_EQ(model->triangles[4], (Triangle{8, 10, 9})) << "its outside stays out";
  EXPECT_TRUE(model->warnings.empty());
}

TEST(Gltf, MeshInTwoNodes_ThatAreOnePlace_StandsOnce) {
  const auto model = face_with_eyes({eye_at(2), eye_at(2)}).import();
  ASSERT_TRUE(model) << model.error().message;
  EXPECT_EQ(model->positions.size(), 8U);
  EXPECT_TRUE(model->warnings.empty());
}

TEST(Gltf, MeshInManyNodes_StandsInEightOfThem_WithAWarning) {
  auto eyes = nlohmann::json::array();
  for (int i = 0; i < 12; ++i) eyes.push_back(eye_at(0.5 * i));
  const auto model = face_with_eyes(eyes).import();
  ASSERT_TRUE(model) << model.error().message;
  EXPECT_EQ(model->positions.size(), 4U + 8 * 4);
  EXPECT_EQ(model->warnings, std::vector<std::string>{"mesh 0 '' is in 12 nodes; only 8 are kept"});
}

TEST(Gltf, MeshInTwoNodes_BeyondALimit_StandsInTheFirst_WithAWarning) {
  ImportLimits limits;
  limits.max_vertices = 11;
  const auto vertices = face_with_eyes({eye_at(2), eye_at(6)}).import(limits);
  ASSERT_TRUE(vertices) << vertices.error().message;
  EXPECT_EQ(vertices->positions.size(), 8U);
  limits = {};
  limits.max_triangles = 5;
  const auto triangles = face_with_eyes({eye_at(2), eye_at(6)}).import(limits);
  ASSERT_TRUE(triangles) << triangles.error().message;
  EXPECT_EQ(triangles->warnings, std::vector<std::string>{"mesh 0 '' is in 2 nodes; only the first is kept"});
}

TEST(Gltf, MeshInTwoNodes_OfTwoHeads_StandsWhereTheFirstPutsIt_WithAWarning) {
  std::string json = replaced(quad_gltf_json(), R"([{"mesh":0}])",
                              R"([{"mesh":0,"translation":[5,0,0]},{"mesh":0,"translation":[9,0,0]}])");
  json = replaced(json, R"([{"nodes":[0]}])", R"([{"nodes":[0,1]}])");
  const auto model = import_json(json);
  ASSERT_TRUE(model);
  EXPECT_EQ(model->positions.size(), 4U);
  EXPECT_EQ(model->positions[0].x, 5.0F);
  EXPECT_EQ(model->warnings.size(), 1U);
}

TEST(Gltf, BlackMaterialThatEmitsAnImage_HasItAsItsColor) {
  const auto material = [](const nlohmann::json& color, const nlohmann::json& emitted) {
    GltfWriter writer;
    writer.add_quad();
    writer.primitive()["material"] = 0;
    writer.json["images"] = {{{"bufferView", writer.view(png_of(4, 4))}}};
    writer.json["textures"] = {{{"source", 0}}};
    writer.json["materials"] = {
        {{"pbrMetallicRoughness", {{"baseColorFactor", color}}}, {"emissiveTexture", {{"index", 0}}}}};
    if (!emitted.is_null()) writer.json["materials"][0]["emissiveFactor"] = emitted;
    const auto model = writer.import();
    EXPECT_TRUE(model) << model.error().where << model.error().message;
    return model ? model->materials[0] : Material{};
  };
  const Material scan = material({0, 0, 0, 1}, {1, 0.5, 1});
  EXPECT_EQ(scan.base_color_image, 0);
  EXPECT_EQ(scan.base_color, glm::vec4(1, 0.5F, 1, 1));
  EXPECT_EQ(scan.metallic, 0.0F);
  EXPECT_EQ(material({0, 0, 0, 1}, nullptr).base_color_image, -1) << "it emits nothing";
  EXPECT_EQ(material({0.5, 0.4, 0.3, 1}, {1, 1, 1}).base_color_image, -1) << "a face with lamps";
}

/// A PNG of this type of colours, up to its pixels, with the chunk tRNS if it has one.
Bytes png_with(std::uint8_t color_type, bool has_transparent_colors) {
  Packer rest(std::endian::big);
  rest.put(std::uint8_t{8}).put(color_type).put(std::uint8_t{0}).put(std::uint8_t{0}).put(std::uint8_t{0});
  rest.put(std::uint32_t{0});  // the checksum
  for (const std::string_view chunk : {"pHYs", has_transparent_colors ? "tRNS" : "IDAT"}) {
    rest.put(std::uint32_t{1});
    for (const char letter : chunk) rest.put(letter);
    rest.put(std::uint8_t{0}).put(std::uint32_t{0});
  }
  Bytes png = png_of(4, 4);
  png.insert(png.end(), rest.bytes.begin(), rest.bytes.end());
  return png;
}

TEST(Gltf, BlendedMaterial_WithoutAnyOpacity_IsOpaque) {
  using Mode = Material::AlphaMode;
  constexpr std::uint8_t rgb = 2, palette = 3, gray_alpha = 4, rgba = 6;
  const auto mode = [](double factor, const Bytes& image) {
    GltfWriter writer;
    writer.add_quad();
    writer.primitive()["material"] = 0;
    nlohmann::json pbr = {{"baseColorFactor", {1, 1, 1, factor}}};
    if (!image.empty()) {
      writer.json["images"] = {{{"bufferView", writer.view(image)}}};
      writer.json["textures"] = {{{"source", 0}}};
      pbr["baseColorTexture"]["index"] = 0;
    }
    writer.json["materials"] = {{{"alphaMode", "BLEND"}, {"pbrMetallicRoughness", pbr}}};
    const auto model = writer.import();
    EXPECT_TRUE(model && model->warnings.empty());
    return model->materials[0].alpha_mode;
  };
  EXPECT_EQ(mode(1.0, {}), Mode::opaque);
  EXPECT_EQ(mode(0.5, {}), Mode::blend);
  EXPECT_EQ(mode(1.0, png_with(rgb, false)), Mode::opaque);
  EXPECT_EQ(mode(0.5, png_with(rgb, false)), Mode::blend);
  EXPECT_EQ(mode(1.0, png_with(palette, false)), Mode::opaque);
  for (const Bytes& image :
       {png_with(palette, true), png_with(rgb, true), png_with(gray_alpha, false), png_with(rgba, false)})
    EXPECT_EQ(mode(1.0, image), Mode::blend);
}

TEST(Gltf, NormalThatIsNoNumber_IsNone) {
  GltfWriter writer;
  writer.add_quad();
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  writer.primitive()["attributes"]["NORMAL"] = writer.floats({0, 0, 1, 0, nan, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
  const auto model = writer.import();
  ASSERT_TRUE(model) << model.error().message;
  EXPECT_EQ(model->normal_triangles, (std::vector<Triangle>{{0, Model::no_index, 2}, {0, 2, 3}}));
  for (const glm::vec3& normal : model->normals) EXPECT_EQ(normal, glm::vec3(0, 0, 1));
}

TEST(Gltf, MeshOutsideTheScene_KeepsItsNumbers_ButIsNotDrawn) {
  const std::string primitive = R"({"attributes":{"POSITION":0},"indices":2})";
  const std::string json =
      replaced(quad_gltf_json(), R"("meshes":[)", R"("meshes":[{"name":"spare","primitives":[)" + primitive + "]},");
  const auto model = import_json(replaced(json, R"([{"mesh":0}])", R"([{"mesh":1}])"));
  ASSERT_TRUE(model) << model.error().message;
  EXPECT_EQ(model->positions.size(), 8U);
  EXPECT_EQ(model->triangles, (std::vector<Triangle>{{4, 5, 6}, {4, 6, 7}}));
  // The uvs of the second mesh stay beside its positions.
  ASSERT_EQ(model->uvs.size(), 8U);
  EXPECT_EQ(model->uv_triangles, model->triangles);
  EXPECT_EQ(model->warnings.size(), 1U);
}

TEST(Gltf, SparseValues_ReplaceThoseOfTheView) {
  // Vertex 2 (the u16 at byte 84 of the buffer) moves to where the first uv pair and what follows it say: (0, 1, 1).
  const auto model = import_json(replaced(
      quad_gltf_json(), R"("bufferView":0,)",
      R"("bufferView":0,"sparse":{"count":1,"indices":{"bufferView":2,"byteOffset":4,"componentType":5123},"values":{"bufferView":1}},)"));
  ASSERT_TRUE(model) << model.error().message;
  EXPECT_EQ(model->positions[2], glm::vec3(0, 1, 1));
  EXPECT_EQ(model->positions[1], glm::vec3(1, 0, 0));
}

TEST(Gltf, NormalizedIntegers_BecomeFractions) {
  // KHR_mesh_quantization: positions as normalized i16 with a stride of 8.
  Packer binary;
  for (const std::array<std::int16_t, 3> p :
       {std::array<std::int16_t, 3>{0, 0, 0}, {32767, 0, 0}, {32767, 32767, 0}, {0, -32768, 0}}) {
    for (const std::int16_t value : p) binary.put(value);
    binary.put(std::int16_t{0});
  }
  const auto model = import_model(make_glb(R"({"asset":{"version":"2.0"},"extensionsRequired":["KHR_mesh_quantization"],
"meshes":[{"primitives":[{"attributes":{"POSITION":0},"mode":6}]}],
"accessors":[{"bufferView":0,"componentType":5122,"normalized":true,"count":4,"type":"VEC3"}],
"bufferViews":[{"buffer":0,"byteLength":32,"byteStride":8}],"buffers":[{"byteLength":32}]})",
                                           binary.bytes),
                                  ModelFormat::glb);
  ASSERT_TRUE(model) << model.error().where << model.error().message;
  EXPECT_EQ(model->positions[2], glm::vec3(1, 1, 0));
  EXPECT_EQ(model->positions[3], glm::vec3(0, -1, 0));
}

TEST(Gltf, Images_AreKeptAsTheyAre_AndOthersLeftOutWithAWarning) {
  Bytes binary = quad_gltf_binary();
  const Bytes png = png_of(4, 4);
  binary.insert(binary.end(), png.begin(), png.end());
  std::string json = replaced(quad_gltf_json(), R"("buffers":[{"byteLength":92}])",
                              R"("buffers":[{"byteLength":116}],"textures":[{"source":0},{"source":1}],
      "images":[{"bufferView":3,"mimeType":"image/jpeg"},{"uri":"skin.png"}])");
  json = replaced(json, R"("byteOffset":80,"byteLength":12})",
                  R"("byteOffset":80,"byteLength":12},{"buffer":0,"byteOffset":92,"byteLength":24})");
  json = replaced(json, R"("baseColorFactor")", R"("baseColorTexture":{"index":0},"baseColorFactor")");
  json = replaced(json, R"({"name":"skin",)", R"({"name":"skin","normalTexture":{"index":1},)");
  const auto model = import_model(make_glb(json, binary), ModelFormat::glb);
  ASSERT_TRUE(model) << model.error().where << model.error().message;
  ASSERT_EQ(model->images.size(), 1U);
  EXPECT_EQ(model->images[0].mime_type, "image/png");  // by its bytes, not by what the file calls it
  EXPECT_EQ(model->images[0].bytes, png);
  EXPECT_EQ(model->materials[0].base_color_image, 0);
  EXPECT_EQ(model->materials[0].normal_image, -1);
  EXPECT_EQ(model->warnings.size(), 1U);
}

TEST(Gltf, PrimitivesOverOneAccessor_CountTowardsTheLimit) {
  std::string primitives;
  for (int i = 0; i < 10; ++i) primitives += R"({"attributes":{"POSITION":0},"indices":2},)";
  const std::string json = replaced(quad_gltf_json(), R"("primitives":[)", "\"primitives\":[" + primitives);
  ImportLimits limits;
  limits.max_vertices = 43;
  auto model = import_json(json, limits);
  ASSERT_FALSE(model);
  EXPECT_EQ(static_cast<int>(model.error().code), static_cast<int>(ErrorCode::too_large));
  EXPECT_EQ(model.error().where, "/meshes/0/primitives/10");
  EXPECT_EQ(model.error().message, "has 4 vertices, only 3 more are allowed");
  limits.max_vertices = 44;
  model = import_json(json, limits);
  ASSERT_TRUE(model);
  EXPECT_EQ(model->positions.size(), 44U);
}

TEST(Draco, HeaderThatAnnouncesMoreThanItsBytesHold_IsRefused_BeforeDecoding) {
  for (const bool edgebreaker : {false, true}) {
    Bytes data = quad_draco_data(edgebreaker);
    // "DRACO", version, type, method, flags: 11 bytes. Then the counts, as varints; the edgebreaker has a byte before.
    const std::size_t at = edgebreaker ? 12 : 11;
    const Bytes huge = {0xFF, 0xFF, 0xFF, 0xFF, 0x04};  // 1.3e9
    data.erase(data.begin() + static_cast<std::ptrdiff_t>(at));
    data.insert(data.begin() + static_cast<std::ptrdiff_t>(at), huge.begin(), huge.end());
    const auto model = import_model(make_glb(quad_draco_json(data.size()), data), ModelFormat::glb);
    ASSERT_FALSE(model);
    EXPECT_NE(model.error().message.find("declares"), std::string::npos) << model.error().message;
    EXPECT_EQ(model.error().where, "/meshes/0/primitives/0/extensions/KHR_draco_mesh_compression");
  }
}

TEST(Draco, WithoutPositions_IsRefused_SinceItsTrianglesCountOtherPoints) {
  const Bytes data = quad_draco_data(true);
  const auto model =
      import_model(make_glb(replaced(quad_draco_json(data.size()), R"("attributes":{"POSITION":0}}}}]}])",
                                     R"("attributes":{"NORMAL":0}}}}]}])"),
                            data),
                   ModelFormat::glb);
  ASSERT_FALSE(model);
  EXPECT_EQ(static_cast<int>(model.error().code), static_cast<int>(ErrorCode::missing));
}

TEST(Draco, AttributeOfBools_IsRefused_WhateverItsBytes) {
  draco::TriangleSoupMeshBuilder builder;
  builder.Start(1);
  const int position = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
  const int flags = builder.AddAttribute(draco::GeometryAttribute::GENERIC, 3, draco::DT_BOOL);
  const std::array<std::array<float, 3>, 3> corners = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
  const std::array<bool, 3> values = {true, false, true};
  builder.SetAttributeValuesForFace(position, draco::FaceIndex(0), corners[0].data(), corners[1].data(),
                                    corners[2].data());
  builder.SetAttributeValuesForFace(flags, draco::FaceIndex(0), values.data(), values.data(), values.data());
  draco::EncoderBuffer buffer;
  ASSERT_TRUE(draco::Encoder().EncodeMeshToBuffer(*builder.Finalize(), &buffer).ok());
  const Bytes data(buffer.data(), buffer.data() + buffer.size());
  const auto model =
      import_model(make_glb(replaced(quad_draco_json(data.size()), R"("attributes":{"POSITION":0}}}}]}])",
                                     R"("attributes":{"POSITION":1}}}}]}])"),
                            data),
                   ModelFormat::glb);
  ASSERT_FALSE(model);
  EXPECT_EQ(static_cast<int>(model.error().code), static_cast<int>(ErrorCode::unsupported)) << model.error().message;
}

TEST(Draco, UnknownAttribute_IsRefused_ByItsPointer) {
  const Bytes data = quad_draco_data(true);
  const auto model =
      import_model(make_glb(replaced(quad_draco_json(data.size()), R"("attributes":{"POSITION":0}}}}]}])",
                                     R"("attributes":{"POSITION":9}}}}]}])"),
                            data),
                   ModelFormat::glb);
  ASSERT_FALSE(model);
  EXPECT_EQ(model.error().where, "/meshes/0/primitives/0/extensions/KHR_draco_mesh_compression/attributes/POSITION");
}

}  // namespace
}  // namespace semblante::test
