#include <cmath>
#include <cstring>
#include <limits>

#include <gtest/gtest.h>

#include "core/import/relative_path.h"
#include "tests/unit/import/test_files.h"

namespace semblante::test {
namespace {

struct InvalidPlyOrStl {
  const char* name;
  const char* what;  ///< what to change in the valid text
  const char* with;
  ErrorCode code;
  const char* where;
};
void PrintTo(const InvalidPlyOrStl& invalid, std::ostream* out) { *out << invalid.name; }

std::string text_of(const Bytes& bytes) { return {bytes.begin(), bytes.end()}; }

void expect_refused(const Result<Model>& model, const InvalidPlyOrStl& invalid) {
  ASSERT_FALSE(model);
  EXPECT_EQ(static_cast<int>(model.error().code), static_cast<int>(invalid.code)) << model.error().message;
  EXPECT_EQ(model.error().where, invalid.where) << model.error().message;
}

class InvalidPly : public ::testing::TestWithParam<InvalidPlyOrStl> {};

TEST_P(InvalidPly, IsRefused_NamingThePlace) {
  const std::string text = replaced(text_of(quad_ply_text()), GetParam().what, GetParam().with);
  expect_refused(import_model(to_bytes(text), ModelFormat::ply), GetParam());
}

const InvalidPlyOrStl invalid_plys[] = {
    {"NoMagic", "ply\n", "plx\n", ErrorCode::malformed, "line 1"},
    {"UnknownFormat", "ascii", "ebcdic", ErrorCode::unsupported, "line 2"},
    {"NoFormat", "format ascii 1.0", "comment", ErrorCode::missing, "line 12"},
    {"NoEndOfHeader", "end_header", "comment", ErrorCode::malformed, "line 13"},
    {"UnknownHeaderLine", "comment", "remark", ErrorCode::malformed, "line 3"},
    {"CountIsText", "vertex 4", "vertex four", ErrorCode::malformed, "line 4"},
    {"CountIsNegative", "vertex 4", "vertex -4", ErrorCode::malformed, "line 4"},
    {"CountBeyond64Bits", "vertex 4", "vertex 99999999999999999999", ErrorCode::malformed, "line 4"},
    {"CountOfBillions", "vertex 4", "vertex 4000000000", ErrorCode::truncated, "line 12"},
    {"TooManyVertices", "vertex 4", "vertex 5", ErrorCode::truncated, "line 17"},
    {"TooManyFaces", "face 1", "face 2", ErrorCode::truncated, "line 17"},
    {"FacesOfBillions", "face 1", "face 18446744073709551615", ErrorCode::truncated, "line 16"},
    {"UnknownType", "float x", "quad x", ErrorCode::malformed, "line 5"},
    {"ListOfFloatCount", "list uchar", "list float", ErrorCode::malformed, "line 11"},
    {"PropertyBeforeElement", "comment a quad", "property int a", ErrorCode::malformed, "line 3"},
    {"NoX", "float x", "float w", ErrorCode::missing, ""},
    {"NoVertices", "element vertex", "element point", ErrorCode::missing, ""},
    {"VerticesTwice", "element face", "element vertex", ErrorCode::malformed, ""},
    {"NoFaceList", "vertex_indices", "corners", ErrorCode::missing, ""},
    {"NoFaces", "face 1", "edge 1", ErrorCode::empty, ""},
    {"CoordinateIsText", "1 1 0 1 1", "1 one 0 1 1", ErrorCode::malformed, "line 15"},
    {"CoordinateIsNaN", "1 1 0 1 1", "1 nan 0 1 1", ErrorCode::not_finite, "line 15"},
    {"CoordinateIsBeyondFloat", "1 1 0 1 1", "1 1e39 0 1 1", ErrorCode::not_finite, "line 15"},
    {"CoordinateIsBeyondDouble", "1 1 0 1 1", "1 1e999 0 1 1", ErrorCode::not_finite, "line 15"},
    {"ListTooLong", "4 0 1 2 3", "255 0 1 2 3", ErrorCode::out_of_range, "line 17"},
    {"ListNegative", "4 0 1 2 3", "-4 0 1 2 3", ErrorCode::out_of_range, "line 17"},
    {"ListOfFraction", "4 0 1 2 3", "3.5 0 1 2 3", ErrorCode::out_of_range, "line 17"},
    {"IndexNegative", "4 0 1 2 3", "4 0 1 2 -1", ErrorCode::out_of_range, "line 17"},
    {"IndexTooLarge", "4 0 1 2 3", "4 0 1 2 4", ErrorCode::out_of_range, "face 0"},
    {"IndexHuge", "4 0 1 2 3", "4 0 1 2 4e18", ErrorCode::out_of_range, "line 17"},
};

INSTANTIATE_TEST_SUITE_P(Ply, InvalidPly, ::testing::ValuesIn(invalid_plys),
                         [](const auto& test) { return test.param.name; });

TEST(Ply, EverythingWeRead_ComesOutAsWritten) {
  const auto model = import_model(
      to_bytes("ply\r\nformat ascii 1.0\r\nelement material 1\r\nproperty int shade\r\nelement vertex 4\r\n"
               "property double z\r\nproperty float y\r\nproperty float x\r\nproperty uchar red\r\n"
               "property float nx\r\nproperty float ny\r\nproperty float nz\r\n"
               "property list uchar float extra\r\nproperty float u\r\nproperty float v\r\n"
               "element face 3\r\nproperty float quality\r\nproperty list int uint vertex_index\r\n"
               "property list uchar float texcoord\r\nelement edge 0\r\nproperty int a\r\nend_header\r\n"
               "7\r\n"
               "0 0 0 255  0 0 3  2 1 1  0.25 0.25\r\n"
               "0 0 1 255  0 0 1  0      1 0\r\n"
               "0 1 1 255  0 0 1  1 5    1 1\r\n"
               "1e-400 1 0 255  0 0 1  0    0 1\r\n"
               "0.5 3 0 1 2  2 9 9\r\n0.5 2 0 1  0\r\n0.5 3 0 2 3  0\r\n"),
      ModelFormat::ply);
  ASSERT_TRUE(model) << model.error().where << ": " << model.error().message;
  EXPECT_EQ(model->positions[2], glm::vec3(1, 1, 0));
  EXPECT_EQ(model->positions[3], glm::vec3(0, 1, 0));
  EXPECT_EQ(model->normals[0], glm::vec3(0, 0, 1));
  EXPECT_EQ(model->uvs[0], glm::vec2(0.25F, 0.75F));
  EXPECT_EQ(model->triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(model->uv_triangles, model->triangles);
  EXPECT_EQ(model->warnings.size(), 2U);  // the colours without green, and the face of two corners
}

// ---- Triangle strips: element tristrips, one list, -1 between strips

constexpr std::string_view strip_vertices = "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n5 0 0\n6 0 0\n5 1 0\n";
// A strip of three triangles, one of a single triangle, one that is too short, one in which 7 7 turns the strip.
const std::vector<std::int32_t> strips = {0, 1, 2, 3, 4, -1, 5, 6, 7, -1, -1, 0, 1, -1, 5, 6, 7, 7, 5};
const std::vector<Triangle> strip_triangles = {{0, 1, 2}, {2, 1, 3}, {2, 3, 4}, {5, 6, 7}, {5, 6, 7}};

std::string strips_header(std::string_view format) {
  return "ply\nformat " + std::string(format) +
         " 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n"
         "element tristrips 1\nproperty list int int vertex_indices\nend_header\n";
}

std::string strips_ply_text() {
  std::string text = strips_header("ascii") + std::string(strip_vertices) + std::to_string(strips.size());
  for (const std::int32_t item : strips) text += " " + std::to_string(item);
  return text + "\n";
}

Bytes strips_ply_binary(std::endian order) {
  const std::string header = strips_header(order == std::endian::little ? "binary_little_endian" : "binary_big_endian");
  Packer data(order);
  for (const std::array<float, 2> at : {std::array{0.F, 0.F}, {1, 0}, {0, 1}, {1, 1}, {0, 2}, {5, 0}, {6, 0}, {5, 1}}) {
    data.put(at[0]).put(at[1]).put(0.0F);
  }
  data.put(static_cast<std::int32_t>(strips.size()));
  for (const std::int32_t item : strips) data.put(item);
  Bytes bytes = to_bytes(header);
  bytes.insert(bytes.end(), data.bytes.begin(), data.bytes.end());
  return bytes;
}

TEST(PlyStrips, InTextAndBothByteOrders_AreTheTrianglesOfEachStrip_AllFacingOneWay) {
  for (const Bytes& bytes :
       {to_bytes(strips_ply_text()), strips_ply_binary(std::endian::little), strips_ply_binary(std::endian::big)}) {
    const auto model = import_model(bytes, ModelFormat::ply);
    ASSERT_TRUE(model) << model.error().where << ": " << model.error().message;
    EXPECT_EQ(model->triangles, strip_triangles);
    EXPECT_TRUE(model->warnings.empty()) << model->warnings.front();
  }
}

TEST(PlyStrips, BesideFaces_AreAddedInTheOrderOfTheFile) {
  const std::string text = replaced(
      replaced(strips_ply_text(), "end_header", "element face 1\nproperty list uchar int vertex_indices\nend_header"),
      "7 7 5\n", "7 7 5\n3 4 3 7\n");
  const auto model = import_model(to_bytes(text), ModelFormat::ply);
  ASSERT_TRUE(model) << model.error().message;
  ASSERT_EQ(model->triangles.size(), strip_triangles.size() + 1);
  EXPECT_EQ(model->triangles.back(), (Triangle{4, 3, 7}));
}

class InvalidStrips : public ::testing::TestWithParam<InvalidPlyOrStl> {};

TEST_P(InvalidStrips, AreRefused_NamingThePlace) {
  const std::string text = replaced(strips_ply_text(), GetParam().what, GetParam().with);
  expect_refused(import_model(to_bytes(text), ModelFormat::ply), GetParam());
}

const InvalidPlyOrStl invalid_strips[] = {
    {"MinusTwo", "7 7 5", "7 7 -2", ErrorCode::out_of_range, "line 18"},
    {"Fraction", "7 7 5", "7 7 0.5", ErrorCode::out_of_range, "line 18"},
    {"BeyondTheVertices", "7 7 5", "7 7 8", ErrorCode::out_of_range, "element 'tristrips'"},
    {"Huge", "7 7 5", "7 7 1e300", ErrorCode::out_of_range, "line 18"},
    {"NotANumber", "7 7 5", "7 7 nan", ErrorCode::out_of_range, "line 18"},
    {"TooLong", "19 0", "400 0", ErrorCode::out_of_range, "line 18"},
    {"NoList", "property list int int vertex_indices", "property int vertex_indices", ErrorCode::missing, ""},
    {"OnlyRestarts", "19 0 1 2 3 4 -1 5 6 7 -1 -1 0 1 -1 5 6 7 7 5", "3 -1 -1 -1", ErrorCode::empty, ""},
};

INSTANTIATE_TEST_SUITE_P(Ply, InvalidStrips, ::testing::ValuesIn(invalid_strips),
                         [](const auto& test) { return test.param.name; });

TEST(PlyStrips, MoreTrianglesThanTheLimit_AreRefused) {
  ImportLimits limits;
  limits.max_triangles = strip_triangles.size();
  EXPECT_TRUE(import_model(to_bytes(strips_ply_text()), ModelFormat::ply, limits));
  --limits.max_triangles;
  const auto model = import_model(to_bytes(strips_ply_text()), ModelFormat::ply, limits);
  ASSERT_FALSE(model);
  EXPECT_EQ(static_cast<int>(model.error().code), static_cast<int>(ErrorCode::too_large));
}

TEST(Ply, NormalThatIsNoNumber_IsNone) {
  const auto model =
      import_model(to_bytes("ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                            "property float z\nproperty float nx\nproperty float ny\nproperty float nz\n"
                            "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
                            "0 0 0 0 0 2\n1 0 0 nan nan nan\n0 1 0 1 -nan 1e99\n3 0 1 2\n"),
                   ModelFormat::ply);
  ASSERT_TRUE(model) << model.error().message;
  EXPECT_EQ(model->normal_triangles, (std::vector<Triangle>{{0, Model::no_index, Model::no_index}}));
  EXPECT_EQ(model->normals.front(), glm::vec3(0, 0, 1));
}

TEST(Ply, BinaryPosition_ThatIsNaN_IsRefused) {
  Packer nan;
  nan.put(std::bit_cast<float>(0x7FC00000U));
  Bytes bytes = quad_ply_binary(std::endian::little);
  // The first vertex begins behind the header: a double x, then y.
  const std::size_t at = text_of(bytes).find("end_header\n") + 11 + 8;
  std::copy(nan.bytes.begin(), nan.bytes.end(), bytes.begin() + static_cast<std::ptrdiff_t>(at));
  const auto model = import_model(bytes, ModelFormat::ply);
  ASSERT_FALSE(model);
  EXPECT_EQ(static_cast<int>(model.error().code), static_cast<int>(ErrorCode::not_finite));
}

TEST(Ply, ElementsThatDoNotEndWithTheirLines_AreTold) {
  const std::string good = text_of(quad_ply_text());
  const auto warnings_of = [&](const char* what, const char* with) {
    const auto model = import_model(to_bytes(replaced(good, what, with)), ModelFormat::ply);
    return model ? model->warnings : std::vector<std::string>{model.error().where + ": " + model.error().message};
  };
  EXPECT_TRUE(warnings_of("comment", "comment").empty());
  EXPECT_TRUE(warnings_of("\n1 1 0 1 1\n", "\n1 1\n0 1 1\n").empty()) << "in two lines, but whole";
  const std::string fault =
      ": an element ends before its line does: a value in or before it may be missing or too many";
  EXPECT_EQ(warnings_of("\n1 1 0 1 1\n", "\n1 1 0 1\n"), std::vector<std::string>{"line 16" + fault})
      << "without its last value: the face would refer to a vertex that is not there";
  EXPECT_EQ(warnings_of("4 0 1 2 3\n", "4 0 1 2 3 7\n"), std::vector<std::string>{"line 17" + fault})
      << "a value too many, after which nothing follows";
}

class InvalidStl : public ::testing::TestWithParam<InvalidPlyOrStl> {};

TEST_P(InvalidStl, IsRefused_NamingTheLine) {
  const std::string text = replaced(
      "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid "
      "a\n",
      GetParam().what, GetParam().with);
  expect_refused(import_model(to_bytes(text), ModelFormat::stl), GetParam());
}

const InvalidPlyOrStl invalid_stls[] = {
    {"NoEnd", "endsolid a\n", "", ErrorCode::truncated, "line 8"},
    {"FacetOfTwo", "vertex 1 0 0\n", "", ErrorCode::malformed, "line 7"},
    {"FacetOfFour", "vertex 1 0 0\n", "vertex 1 0 0\nvertex 1 1 0\n", ErrorCode::malformed, "line 7"},
    {"CoordinateIsText", "vertex 1 0 0", "vertex 1 O 0", ErrorCode::malformed, "line 5"},
    {"CoordinateIsMissing", "vertex 1 0 0", "vertex 1 0", ErrorCode::malformed, "line 5"},
    {"CoordinateIsNaN", "vertex 1 0 0", "vertex nan 0 0", ErrorCode::not_finite, "line 5"},
    {"UnknownWord", "endloop", "end loop", ErrorCode::malformed, "line 7"},
    {"OnlyDegenerate", "vertex 1 0 0", "vertex 0 0 0", ErrorCode::empty, ""},
};

INSTANTIATE_TEST_SUITE_P(Stl, InvalidStl, ::testing::ValuesIn(invalid_stls),
                         [](const auto& test) { return test.param.name; });

TEST(Stl, BinaryCount_BeyondItsBytes_IsRefused_BeforeAllocating) {
  for (const std::uint32_t count : {3U, 0x7FFFFFFFU, 0xFFFFFFFFU}) {
    Bytes bytes = quad_stl_binary();
    std::memcpy(bytes.data() + 80, &count, 4);
    const auto model = import_model(bytes, ModelFormat::stl);
    ASSERT_FALSE(model);
    EXPECT_EQ(static_cast<int>(model.error().code), static_cast<int>(ErrorCode::truncated));
    EXPECT_EQ(model.error().where, "byte 80");
  }
}

TEST(Stl, BinaryPosition_ThatIsInfinite_IsRefused_ByItsFacet) {
  Bytes bytes = quad_stl_binary();
  const float infinity = std::numeric_limits<float>::infinity();
  std::memcpy(bytes.data() + 84 + 50 + 12, &infinity, 4);
  const auto model = import_model(bytes, ModelFormat::stl);
  ASSERT_FALSE(model);
  EXPECT_EQ(static_cast<int>(model.error().code), static_cast<int>(ErrorCode::not_finite));
  EXPECT_EQ(model.error().where, "facet 1");
}

TEST(Stl, CornersAtOnePosition_AreOneVertex_InOrderOfAppearance) {
  // 0 1 2 / 0 2 3 of the quad; -0 in the second facet is the same place as +0.
  Bytes bytes = quad_stl_binary();
  const float minus_zero = -0.0F;
  std::memcpy(bytes.data() + 84 + 50 + 12, &minus_zero, 4);
  const auto model = import_model(bytes, ModelFormat::stl);
  ASSERT_TRUE(model);
  EXPECT_EQ(model->positions, (std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
  EXPECT_EQ(model->triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_FALSE(std::signbit(model->positions[0].x));
}

TEST(Stl, WordsInUpperCase_AreWordsToo) {
  std::string text = text_of(quad_stl_text());
  std::transform(text.begin(), text.end(), text.begin(),
                 [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; });
  const Bytes bytes = to_bytes(text);
  EXPECT_EQ(detect_format(bytes, ""), ModelFormat::stl);
  const auto model = import_model(bytes, ModelFormat::stl);
  ASSERT_TRUE(model) << model.error().message;
  EXPECT_EQ(model->triangles.size(), 2U);
}

TEST(Stl, BinaryFile_ThatBeginsWithSolid_IsBinary) {
  Bytes bytes = quad_stl_binary();
  std::copy_n("solid facet", 11, bytes.begin());
  const auto model = import_model(bytes, ModelFormat::stl);
  ASSERT_TRUE(model) << model.error().message;
  EXPECT_EQ(model->triangles.size(), 2U);
}

TEST(Zip, Paths_NeverLeaveTheZip) {
  using import::resolve_below;
  EXPECT_EQ(resolve_below("", "a.bin"), "a.bin");
  EXPECT_EQ(resolve_below("head/", "a.bin"), "head/a.bin");
  EXPECT_EQ(resolve_below("head/", "../textures/skin%20a.png"), "textures/skin a.png");
  EXPECT_EQ(resolve_below("head/", "./b//c/../a.bin"), "head/b/a.bin");
  for (const char* const uri : {"", "/etc/passwd", "../../a", "http://x/a", "file:a", "C:\\a", "a\\b", "%2e%2e/../a",
                                "%2fetc", "a%00b", "%zz", "%2", "..", "."}) {
    EXPECT_EQ(resolve_below("", uri), std::nullopt) << uri;
  }
}

TEST(Zip, Quad_InAFolder_FindsItsBuffer) {
  const auto model = import_model(quad_zip(), ModelFormat::gltf_zip);
  ASSERT_TRUE(model) << model.error().where << model.error().message;
  EXPECT_EQ(model->positions.size(), 4U);
  EXPECT_EQ(model->format, "gltf");
}

TEST(Zip, Glb_Alone_IsRead) {
  const auto model =
      import_model(make_zip({{"readme.txt", to_bytes("x")}, {"Head.GLB", quad_glb()}}), ModelFormat::gltf_zip);
  ASSERT_TRUE(model) << model.error().where << model.error().message;
}

TEST(Zip, PlyAndStl_BesideOtherFiles_AreRead) {
  for (const auto& [name, bytes] : {std::pair{"scan/Head.PLY", quad_ply_binary(std::endian::big)},
                                    std::pair{"files/head.stl", quad_stl_binary()}}) {
    const auto model = import_model(
        make_zip({{"licence.txt", to_bytes("x")}, {"__MACOSX/files/._head.stl", to_bytes("x")}, {name, bytes}}),
        ModelFormat::gltf_zip);
    ASSERT_TRUE(model) << name << model.error().where << model.error().message;
    EXPECT_EQ(model->positions.size(), 4U) << name;
  }
}

TEST(Zip, NamesWithBackslashes_AreThoseWithSlashes) {
  const std::string json = replaced(quad_gltf_json(), R"({"byteLength":92})", R"({"byteLength":92,"uri":"quad.bin"})");
  const auto model = import_model(
      make_zip({{"head\\quad.gltf", to_bytes(json)}, {"head\\quad.bin", quad_gltf_binary()}}), ModelFormat::gltf_zip);
  EXPECT_TRUE(model) << model.error().message;
}

TEST(Zip, Gltf_FindsItsFiles_InOtherFoldersAndCapitals) {
  const auto read = [](const std::string& uri, const std::vector<std::pair<std::string, Bytes>>& files) {
    auto entries = files;
    const std::string json =
        replaced(quad_gltf_json(), R"({"byteLength":92})", R"({"byteLength":92,"uri":")" + uri + "\"}");
    entries.emplace_back("head/quad.gltf", to_bytes(json));
    return import_model(make_zip(entries), ModelFormat::gltf_zip);
  };
  const Bytes right = quad_gltf_binary();
  const Bytes wrong = {0};
  EXPECT_TRUE(read("Buffers/My%20Quad.bin", {{"head/buffers/my quad.BIN", right}}));
  EXPECT_TRUE(read("C:\\\\heads\\\\quad.bin", {{"quad.bin", right}}));
  EXPECT_TRUE(read("quad.bin", {{"head/quad.bin", right}, {"old/quad.bin", wrong}})) << "its own path says more";
  const auto two = read("quad.bin", {{"a/quad.bin", right}, {"b/quad.bin", right}});
  ASSERT_FALSE(two);
  EXPECT_EQ(two.error().message, "the zip has no entry 'head/quad.bin'");
}

TEST(Zip, ResourceForkBesideItsModel_IsNoModel) {
  const auto model = import_model(make_zip({{"scan/._head.obj", to_bytes("x")}, {"scan/head.obj", quad_obj()}}),
                                  ModelFormat::gltf_zip);
  EXPECT_TRUE(model) << model.error().message;
}

TEST(Zip, WithoutAModel_NamesTheFileThatMayBeMeant) {
  const auto words = [](const char* name) {
    return import_model(make_zip({{"a.txt", to_bytes("x")}, {name, to_bytes("y")}}), ModelFormat::gltf_zip)
        .error()
        .message;
  };
  EXPECT_EQ(words("source/Head.FBX"), "the zip has no model but 'source/Head.FBX'");
  EXPECT_EQ(words("head.usdc"), "the zip has no model but 'head.usdc'") << "a .usdz file";
  EXPECT_EQ(words("source/head.zip"), "the zip has no model but 'source/head.zip'");
  EXPECT_EQ(words("b.txt"), "the zip has no .gltf, .glb, .vrm, .obj, .ply or .stl file");
  EXPECT_EQ(words("__MACOSX/._head.fbx"), "the zip has no .gltf, .glb, .vrm, .obj, .ply or .stl file");
}

TEST(Zip, WithoutOneModel_HasWhatHelps) {
  const auto advice = [](const char* name, const char* other) {
    return import_model(make_zip({{name, to_bytes("x")}, {other, to_bytes("y")}}), ModelFormat::gltf_zip)
        .error()
        .advice;
  };
  EXPECT_EQ(advice("a.txt", "source/Head.FBX"), Advice::export_as_glb);
  EXPECT_EQ(advice("a.txt", "source/head.zip"), Advice::unpack);
  EXPECT_EQ(advice("a.txt", "b.txt"), Advice::export_as_glb);
  EXPECT_EQ(advice("a.ply", "b.ply"), Advice::send_one_model);
}

TEST(Zip, Obj_WithItsMaterialsAndImages_IsReadWhole) {
  const Bytes png = png_of(4, 4);
  const std::string mtl =
      "# exported\nnewmtl skin\nKd 0.5 0.25 1.5\nd 0.5\nmap_Kd -s 1 1 1 -bm 0.5 C:\\heads\\Skin Colour.png\n"
      "norm ../../etc/passwd\nnewmtl unused\nKd 1 0 0\nPr 0.25\nmap_Kd gone.png\n";
  const auto model = import_model(
      make_zip({{"a/head.obj", quad_obj()}, {"a/quad.mtl", to_bytes(mtl)}, {"a/textures/skin colour.PNG", png}}),
      ModelFormat::gltf_zip);
  ASSERT_TRUE(model) << model.error().message;
  EXPECT_EQ(model->format, "obj");
  ASSERT_EQ(model->materials.size(), 1U);
  const Material& skin = model->materials[0];
  EXPECT_EQ(skin.name, "skin");
  EXPECT_EQ(skin.base_color, glm::vec4(1, 1, 1, 0.5F)) << "the texture's colour, the file's opacity";
  EXPECT_EQ(skin.alpha_mode, Material::AlphaMode::blend);
  ASSERT_EQ(skin.base_color_image, 0);
  EXPECT_EQ(model->images[0].bytes, png);
  EXPECT_EQ(model->images[0].mime_type, "image/png");
  ASSERT_EQ(model->warnings.size(), 1U) << "nothing uses gone.png";
  EXPECT_NE(model->warnings[0].find("passwd"), std::string::npos) << "the path out of the zip";
}

TEST(Zip, Obj_WithTwoMaterialFilesInALine_ReadsBoth) {
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\nusemtl b\nf 3 2 1\n";
  const auto model = import_model(make_zip({{"head.obj", to_bytes("mtllib skin.mtl  Eyes.MTL \n" + triangle)},
                                            {"skin.mtl", to_bytes("newmtl a\nKd 1 0 0\n")},
                                            {"eyes.mtl", to_bytes("newmtl b\nKd 0 0 1\n")}}),
                                  ModelFormat::gltf_zip);
  ASSERT_TRUE(model) << model.error().message;
  EXPECT_EQ(model->materials[0].base_color, glm::vec4(1, 0, 0, 1));
  EXPECT_EQ(model->materials[1].base_color, glm::vec4(0, 0, 1, 1));
  EXPECT_TRUE(model->warnings.empty());
}

TEST(Zip, Obj_WithoutItsMaterialFile_IsStillAHead) {
  const auto model = import_model(make_zip({{"head.obj", quad_obj()}}), ModelFormat::gltf_zip);
  ASSERT_TRUE(model) << model.error().message;
  EXPECT_EQ(model->materials.size(), 1U);
  EXPECT_EQ(model->warnings.size(), 1U);
}

TEST(Zip, MaterialFile_OfGarbage_ChangesNothing) {
  std::string text;
  for (int i = 0; i < 4000; ++i) text += static_cast<char>(i * 73 % 256);
  const auto model = import_model(
      make_zip({{"head.obj", quad_obj()}, {"quad.mtl", to_bytes("newmtl skin\nKd x y z\nmap_Kd\nmap_Kd -s\n" + text)}}),
      ModelFormat::gltf_zip);
  ASSERT_TRUE(model) << model.error().message;
  EXPECT_EQ(model->materials[0].base_color, glm::vec4(1.0F));
  EXPECT_EQ(model->materials[0].base_color_image, -1);
}

TEST(Zip, MaterialFile_LooksForSoManyImagesOnly) {
  const auto images_after = [](int missing) {
    std::string obj = "mtllib quad.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\n";
    std::string mtl;
    for (int i = 0; i <= missing; ++i) {
      const std::string name = i < missing ? std::to_string(i) : "there";
      obj += "usemtl " + name + "\nf 1 2 3\n";
      mtl += "newmtl " + name + "\nmap_Kd " + name + ".png\n";
    }
    const auto model =
        import_model(make_zip({{"head.obj", to_bytes(obj)}, {"quad.mtl", to_bytes(mtl)}, {"there.png", png_of(4, 4)}}),
                     ModelFormat::gltf_zip);
    return model->images.size();
  };
  EXPECT_EQ(images_after(1000), 1U);
  EXPECT_EQ(images_after(1024), 0U);
}

TEST(Zip, InvalidArchives_AreRefused) {
  const auto code_of = [](const Bytes& bytes, const ImportLimits& limits = {}) {
    const auto model = import_model(bytes, ModelFormat::gltf_zip, limits);
    return model ? -1 : static_cast<int>(model.error().code);
  };
  const Bytes json =
      to_bytes(replaced(quad_gltf_json(), "[{\"byteLength\":92}]", "[{\"byteLength\":92,\"uri\":\"quad.bin\"}]"));
  EXPECT_EQ(code_of(to_bytes("PK\x03\x04 and no more")), static_cast<int>(ErrorCode::malformed));
  EXPECT_EQ(code_of(make_zip({{"a.txt", to_bytes("x")}})), static_cast<int>(ErrorCode::missing)) << "no model";
  EXPECT_EQ(code_of(make_zip({{"a.gltf", json}, {"b.gltf", json}})), static_cast<int>(ErrorCode::invalid_argument))
      << "two models";
  EXPECT_EQ(code_of(make_zip({{"a.gltf", json}})), static_cast<int>(ErrorCode::missing)) << "no buffer";
  EXPECT_EQ(code_of(make_zip({{"a.gltf", to_bytes("{")}})), static_cast<int>(ErrorCode::malformed)) << "bad JSON";

  // 40 MB of zeros deflate to 40 kB: refused at the limit, not inflated to the end.
  ImportLimits small;
  small.max_file_bytes = 1 << 20;
  const Bytes bomb = make_zip({{"a.gltf", json}, {"quad.bin", Bytes(40 << 20, 0)}});
  ASSERT_LT(bomb.size(), small.max_file_bytes);
  EXPECT_EQ(code_of(bomb, small), static_cast<int>(ErrorCode::too_large)) << "bomb";

  std::vector<std::pair<std::string, Bytes>> many;
  for (int i = 0; i < 5000; ++i) many.emplace_back(std::to_string(i), Bytes{});
  EXPECT_EQ(code_of(make_zip(many)), static_cast<int>(ErrorCode::too_large)) << "entries";
}

/// A zip of the quad whose material has two images, the second of 100 bytes; the size of the first is `declared`.
Bytes zip_with_a_large_image(std::size_t size, std::uint32_t declared) {
  Bytes small = png_of(4, 4);
  small.resize(100);
  Bytes bytes = make_zip({{"head.obj", quad_obj()},
                          {"quad.mtl", to_bytes("newmtl skin\nmap_Kd large.png\nnorm small.png\n")},
                          {"large.png", Bytes(size, 0)},
                          {"small.png", small}});
  // The entry in the directory: the size is 24 bytes in, the name 46.
  const std::size_t name = text_of(bytes).rfind("large.png");
  std::memcpy(bytes.data() + name - 46 + 24, &declared, 4);
  return bytes;
}

TEST(Zip, EntryOfAnHonestSize_ThatIsTooLarge_IsNotInflated) {
  ImportLimits limits;
  limits.max_file_bytes = 1 << 20;
  const auto model = import_model(zip_with_a_large_image(2 << 20, 2 << 20), ModelFormat::gltf_zip, limits);
  ASSERT_TRUE(model) << model.error().message;
  EXPECT_EQ(model->images.size(), 1U) << "the small one";
  ASSERT_EQ(model->warnings.size(), 1U);
  EXPECT_NE(model->warnings[0].find("large.png"), std::string::npos) << model->warnings[0];
}

TEST(Zip, EntryThatIsLargerThanItSays_CountsAsInflated) {
  // Otherwise a model could let a few kilobytes be inflated again and again, by each of its images.
  ImportLimits limits;
  limits.max_file_bytes = 1 << 20;
  const auto model = import_model(zip_with_a_large_image(2 << 20, 100), ModelFormat::gltf_zip, limits);
  ASSERT_TRUE(model) << model.error().message;
  EXPECT_TRUE(model->images.empty());
  ASSERT_EQ(model->warnings.size(), 2U);
  EXPECT_NE(model->warnings[1].find("the zip's files inflate to more than 1048576 bytes together"), std::string::npos)
      << model->warnings[1];
}

TEST(Zip, DamagedEntry_IsRefused_ByItsChecksum) {
  Bytes bytes = quad_zip();
  const std::string text = text_of(bytes);
  // In the first local header: the CRC of the entry, 14 bytes in; and its copy in the directory.
  bytes[text.find("PK\x01\x02") + 16] ^= 0xFF;
  EXPECT_FALSE(import_model(bytes, ModelFormat::gltf_zip));
}

}  // namespace
}  // namespace semblante::test
