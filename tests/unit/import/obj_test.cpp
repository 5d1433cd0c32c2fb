#include <gtest/gtest.h>

#include "tests/unit/import/test_files.h"

namespace semblante::test {
namespace {

Result<Model> import_obj(std::string_view text, const ImportLimits& limits = {}) {
  return import_model(to_bytes(text), ModelFormat::obj, limits);
}

struct InvalidObjFile {
  const char* name;
  const char* text;
  ErrorCode code;
  const char* where;
};
void PrintTo(const InvalidObjFile& invalid, std::ostream* out) { *out << invalid.name; }

class InvalidObj : public ::testing::TestWithParam<InvalidObjFile> {};

TEST_P(InvalidObj, IsRefused_NamingTheLine) {
  const auto model = import_obj(GetParam().text);
  ASSERT_FALSE(model);
  EXPECT_EQ(static_cast<int>(model.error().code), static_cast<int>(GetParam().code)) << model.error().message;
  EXPECT_EQ(model.error().where, GetParam().where) << model.error().message;
}

constexpr const char* no_line = "";
const InvalidObjFile invalid_objs[] = {
    {"NoTriangles", "v 0 0 0\nv 1 0 0\nv 0 1 0\n", ErrorCode::empty, no_line},
    {"OnlyLines", "v 0 0 0\nv 1 0 0\nl 1 2\n", ErrorCode::empty, no_line},
    {"OnlyTwoCornerFaces", "v 0 0 0\nv 1 0 0\nf 1 2\n", ErrorCode::empty, no_line},
    {"OnlyRepeatedCorners", "v 0 0 0\nv 1 0 0\nf 1 2 1\n", ErrorCode::empty, no_line},
    {"AllInOnePlace", "v 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3\n", ErrorCode::empty, no_line},
    {"Prose", "once upon a time\nthere was a head\n", ErrorCode::malformed, "line 1"},
    {"PositionOfTwo", "v 0 0 0\nv 1 2\n", ErrorCode::truncated, "line 2"},
    {"PositionIsText", "v 0 0 0\nv 1 two 3\n", ErrorCode::malformed, "line 2"},
    {"PositionHasTail", "v 0 0 0x\n", ErrorCode::malformed, "line 1"},
    {"PositionIsNaN", "v 0 0 0\n\nv nan 0 0\n", ErrorCode::not_finite, "line 3"},
    {"PositionIsInf", "v 0 0 0\r\nv 0 -inf 0\r\n", ErrorCode::not_finite, "line 2"},
    {"PositionIsBeyondFloat", "v 1e39 0 0\n", ErrorCode::not_finite, "line 1"},
    {"PositionIsBeyondDouble", "v 1e999 0 0\n", ErrorCode::not_finite, "line 1"},
    {"PositionIsBeyondAnyUnit", "v 1e20 0 0\nv 0 1 0\nv 1 0 0\nf 1 2 3\n", ErrorCode::out_of_range, "vertex 0"},
    {"UvIsNaN", "vt nan 0\n", ErrorCode::not_finite, "line 1"},
    {"PositionIsNaNOfOldWindows", "v 0 1.#QNAN0 0\n", ErrorCode::not_finite, "line 1"},
    {"NormalIsText", "vn 0 0 up\n", ErrorCode::malformed, "line 1"},
    {"FaceOfText", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf a b c\n", ErrorCode::malformed, "line 4"},
    {"FaceWithEmptyIndex", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 /1\n", ErrorCode::malformed, "line 4"},
    {"FaceWithFraction", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3.5\n", ErrorCode::malformed, "line 4"},
    {"IndexZero", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n", ErrorCode::out_of_range, "line 4"},
    {"IndexTooLarge", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 4\nf 1 2 9\n", ErrorCode::out_of_range, "line 5"},
    {"IndexTooNegative", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -1 -2 -4\n", ErrorCode::out_of_range, "line 4"},
    {"IndexBeyondAnyInteger", "v 0 0 0\nf 1 1 99999999999999999999999\n", ErrorCode::out_of_range, "line 2"},
    {"UvIndexTooLarge", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/2\n", ErrorCode::out_of_range, "line 5"},
    {"NormalIndexTooLarge", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1//1 2//1 3//1\n", ErrorCode::out_of_range, "line 4"},
};

INSTANTIATE_TEST_SUITE_P(Obj, InvalidObj, ::testing::ValuesIn(invalid_objs),
                         [](const auto& test) { return test.param.name; });

TEST(Obj, ZeroBytes_AreRefused_AsNotText) {
  Bytes bytes = quad_obj();
  bytes.push_back(0);
  const auto model = import_model(bytes, ModelFormat::obj);
  ASSERT_FALSE(model);
  EXPECT_EQ(static_cast<int>(model.error().code), static_cast<int>(ErrorCode::malformed));
}

TEST(Obj, NormalThatIsNoNumber_IsNone) {
  for (const char* const no_number : {"nan nan nan", "1 -nan(ind) 0", "1 inf 0", "1.#QNAN0 -1.#IND00 1.#INF"}) {
    const std::string text =
        std::string("v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nvn ") + no_number + "\nf 1//1 2//2 3//1\n";
    const auto model = import_model(to_bytes(text), ModelFormat::obj);
    ASSERT_TRUE(model) << model.error().message;
    EXPECT_EQ(model->normal_triangles, (std::vector<Triangle>{{0, Model::no_index, 0}})) << no_number;
  }
}

TEST(Obj, EverythingWeRead_ComesOutAsWritten) {
  const auto model = import_obj(
      "\xEF\xBB\xBF# comment\r\n"
      "mtllib none.mtl\r\n"
      "v 0 0 0\r\n"
      "v 1 0 0 1.0\r\n"            // w
      "v 1 1 0 0.5 0.5 0.5\r\n"    // colour
      "v +0 1e0 0 # a remark\r\n"  //
      "v 9 9 9\r\n"                // used by no face
      "v 2 1e-60 \\\r\n"           // underflow, and goes on
      "  0\r\n"
      "vt 0.25 0.25\r\nvt 1\r\nvn 0 0 2\r\n"
      "o head\r\ng skin\r\nusemtl face skin\r\n"
      "f 1/1/1 2/2/1 3\r\n"
      "s off\r\nl 1 2\r\n"
      "g eye\r\nusemtl iris\r\n"
      "f -6//-1 -4//1 -3//1 # quad's other half\r\n"
      "usemtl face skin\r\n"
      "f 2 6 3");
  ASSERT_TRUE(model) << model.error().where << ": " << model.error().message;
  ASSERT_EQ(model->positions.size(), 6U);
  EXPECT_EQ(model->positions[3], glm::vec3(0, 1, 0));
  EXPECT_EQ(model->positions[4], glm::vec3(9, 9, 9));
  EXPECT_EQ(model->positions[5], glm::vec3(2, 0, 0));
  ASSERT_EQ(model->triangles.size(), 3U);
  EXPECT_EQ(model->triangles[1], (Triangle{0, 2, 3}));
  EXPECT_EQ(model->uv_triangles[0], (Triangle{0, 1, Model::no_index}));
  EXPECT_EQ(model->uvs[0], glm::vec2(0.25F, 0.75F));
  EXPECT_EQ(model->uvs[1], glm::vec2(1.0F, 1.0F));
  EXPECT_EQ(model->normals[0], glm::vec3(0, 0, 1));
  EXPECT_EQ(model->normal_triangles[2], (Triangle{Model::no_index, Model::no_index, Model::no_index}));
  ASSERT_EQ(model->primitives.size(), 3U);
  EXPECT_EQ(model->primitives[0].name, "skin");
  EXPECT_EQ(model->primitives[1].name, "eye");
  EXPECT_EQ(model->primitives[2].name, "eye");
  ASSERT_EQ(model->materials.size(), 2U);
  EXPECT_EQ(model->materials[0].name, "face skin");
  EXPECT_EQ(model->primitives[1].material, 1);
  EXPECT_EQ(model->primitives[2].material, 0);
  ASSERT_EQ(model->warnings.size(), 1U);
  EXPECT_NE(model->warnings[0].find("none.mtl"), std::string::npos);
}

TEST(Obj, Face_BeforeItsVertices_IsRead) {
  const auto model = import_obj("f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\n");
  ASSERT_TRUE(model) << model.error().message;
  EXPECT_EQ(model->triangles[0], (Triangle{0, 1, 2}));
}

TEST(Obj, RepeatedCorners_AreLeftOut_AndCounted) {
  const auto model = import_obj("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 2\nf 1 2 3\nf 3 3 3\n");
  ASSERT_TRUE(model);
  EXPECT_EQ(model->triangles.size(), 1U);
  ASSERT_EQ(model->warnings.size(), 1U);
  EXPECT_NE(model->warnings[0].find("2 triangles"), std::string::npos);
}

TEST(Obj, Names_ThatAreNotUtf8_ComeOutPrintable) {
  const auto model = import_obj("v 0 0 0\nv 1 0 0\nv 0 1 0\ng \xFF\xC0 caf\xC3\xA9 \x07\nf 1 2 3\n");
  ASSERT_TRUE(model);
  EXPECT_EQ(model->primitives[0].name, "?? caf\xC3\xA9 ?");
}

TEST(Obj, HugeName_OfManySections_IsNotKeptManyTimes) {
  // 10 MB of name, 2000 sections: 20 GB if each kept it whole.
  std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\ng " + std::string(10'000'000, 'x') + "\n";
  for (int i = 0; i < 1000; ++i) text += "usemtl a\nf 1 2 3\nusemtl b\nf 1 2 3\n";
  const auto model = import_obj(text);
  ASSERT_TRUE(model);
  EXPECT_EQ(model->primitives.size(), 2000U);
  EXPECT_EQ(model->primitives[0].name, std::string(200, 'x'));
}

TEST(Obj, Triangles_OverTheLimit_AreRefused_BeforeTheyAreMade) {
  std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf";
  for (int i = 0; i < 1000; ++i) text += " 1 2 3";
  ImportLimits limits;
  limits.max_triangles = 2997;  // 3000 corners make 2998
  const auto model = import_obj(text, limits);
  ASSERT_FALSE(model);
  EXPECT_EQ(model.error().where, "line 4");
}

TEST(Obj, ErrorsShowOtherAlphabets_ButNoControlCharacters) {
  const auto message = [](const std::string& token) {
    const auto model = import_model(to_bytes("v 0 0 " + token + "\n"), ModelFormat::obj);
    return model ? std::string() : model.error().message;
  };
  EXPECT_NE(message("\u00E9\u4F60").find("'\u00E9\u4F60'"), std::string::npos) << message("\u00E9\u4F60");
  EXPECT_NE(message("\x1B[31m\xFF").find("'?[31m?'"), std::string::npos) << message("\x1B[31m\xFF");
  std::string long_name(39, 'a');
  EXPECT_NE(message(long_name + "\u00E9").find("'" + long_name + "...'"), std::string::npos) << "no half a character";
}

}  // namespace
}  // namespace semblante::test
