#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/import/gltf_writer.h"

namespace semblante::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr Color8 red = {255, 0, 0};

/// A PLY of one triangle with these properties of colours and these values in the vertices' lines.
Result<Model> import_ply(const std::string& properties, const std::array<std::string, 3>& values) {
  return import_model(
      to_bytes("ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
               "property float z\n" +
               properties + "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0 " + values[0] +
               "\n1 0 0 " + values[1] + "\n0 1 0 " + values[2] + "\n3 0 1 2\n"),
      ModelFormat::ply);
}

std::string rgb(const std::string& type, const std::string& before = "") {
  std::string text;
  for (const char* const name : {"red", "green", "blue"}) text += "property " + type + " " + before + name + "\n";
  return text;
}

struct PlyColors {
  const char* name;
  std::string properties;
  std::array<std::string, 3> values;
};
void PrintTo(const PlyColors& colors, std::ostream* out) { *out << colors.name; }

class ColorsOfPly : public ::testing::TestWithParam<PlyColors> {};

TEST_P(ColorsOfPly, AreRead) {
  const auto model = import_ply(GetParam().properties, GetParam().values);
  ASSERT_TRUE(model) << model.error().message;
  EXPECT_THAT(model->colors, ElementsAre(red, Color8{0, 51, 0}, white));
  EXPECT_TRUE(model->primitives[0].has_colors);
  EXPECT_THAT(model->warnings, IsEmpty());
}

const PlyColors ply_colors[] = {
    {"Bytes", rgb("uchar"), {"255 0 0", "0 51 0", "255 255 255"}},
    {"Opacity", rgb("uchar") + "property uchar alpha\n", {"255 0 0 9", "0 51 0 0", "255 255 255 255"}},
    {"Diffuse", rgb("uchar", "diffuse_"), {"255 0 0", "0 51 0", "255 255 255"}},
    {"Letters", "property uchar b\nproperty uchar g\nproperty uchar r\n", {"0 0 255", "0 51 0", "255 255 255"}},
    {"Floats", rgb("float"), {"1 0 0", "0 0.2 0", "1 1 1"}},
    {"FloatsOutOfRange", rgb("float"), {"1.5 -0.5 0", "0 0.2 0", "1 1 1"}},
    {"FloatsOfBytes", rgb("double"), {"255 0 0", "0 51 0", "255 255 255"}},
    {"Shorts", rgb("ushort"), {"65535 0 0", "0 13107 0", "65535 65535 65535"}},
    {"ShortsOfBytes", rgb("ushort"), {"255 0 0", "0 51 0", "255 255 255"}},
    {"IntegersOfBytes", rgb("int"), {"255 0 0", "0 51 0", "255 255 255"}},
};

INSTANTIATE_TEST_SUITE_P(Ply, ColorsOfPly, ::testing::ValuesIn(ply_colors),
                         [](const auto& test) { return test.param.name; });

TEST(PlyColors, OfBinaryFiles_InBothOrders) {
  for (const std::endian order : {std::endian::little, std::endian::big}) {
    const std::string format = order == std::endian::little ? "little" : "big";
    Packer data(order);
    for (const char c : "ply\nformat binary_" + format + "_endian 1.0\nelement vertex 3\nproperty float x\n" +
                            "property float y\nproperty float z\n" + rgb("ushort") +
                            "element face 1\nproperty list uchar int vertex_indices\nend_header\n")
      data.put(c);
    data.put(0.0F).put(0.0F).put(0.0F).put(std::uint16_t{65535}).put(std::uint16_t{0}).put(std::uint16_t{0});
    data.put(1.0F).put(0.0F).put(0.0F).put(std::uint16_t{0}).put(std::uint16_t{13107}).put(std::uint16_t{0});
    data.put(0.0F).put(1.0F).put(0.0F).put(std::uint16_t{65535}).put(std::uint16_t{65535}).put(std::uint16_t{65535});
    data.put(std::uint8_t{3}).put(0).put(1).put(2);
    const auto model = import_model(data.bytes, ModelFormat::ply);
    ASSERT_TRUE(model) << model.error().message;
    EXPECT_THAT(model->colors, ElementsAre(red, Color8{0, 51, 0}, white)) << format;
  }
}

TEST(PlyColors, ThatAreNoNumbers_AreWhite_WithAWarning) {
  const auto model = import_ply(rgb("float"), {"1 0 0", "nan 0 0", "1e30 0 0"});
  ASSERT_TRUE(model) << model.error().message;
  EXPECT_THAT(model->colors, ElementsAre(red, white, white));
  EXPECT_THAT(model->warnings, ElementsAre("2 vertices have a colour that is not three numbers: they are white"));
}

TEST(PlyColors, OnlyWhiteOnes_AreNone) {
  const auto model = import_ply(rgb("uchar"), {"255 255 255", "255 255 255", "255 255 255"});
  ASSERT_TRUE(model) << model.error().message;
  EXPECT_THAT(model->colors, IsEmpty());
  EXPECT_FALSE(model->primitives[0].has_colors);
  EXPECT_THAT(model->warnings, IsEmpty());
}

TEST(PlyColors, OnlyBlackOnes_AreNone_WithAWarning) {
  const auto model = import_ply(rgb("uchar"), {"0 0 0", "0 0 0", "0 0 0"});
  ASSERT_TRUE(model) << model.error().message;
  EXPECT_THAT(model->colors, IsEmpty());
  EXPECT_FALSE(model->primitives[0].has_colors);
  EXPECT_THAT(model->warnings, ElementsAre(HasSubstr("all vertex colours are black")));
}

TEST(PlyColors, WithoutAChannel_AreNone_WithAWarning) {
  const auto model = import_ply("property uchar red\nproperty uchar blue\n", {"1 2", "3 4", "5 6"});
  ASSERT_TRUE(model) << model.error().message;
  EXPECT_THAT(model->colors, IsEmpty());
  EXPECT_THAT(model->warnings, ElementsAre(HasSubstr("green or blue is missing")));
}

TEST(PlyColors, OfFaces_AreNone_WithAWarning) {
  const auto model = import_model(
      to_bytes("ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
               "element face 1\nproperty list uchar int vertex_indices\n" +
               rgb("uchar") + "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 255 0 0\n"),
      ModelFormat::ply);
  ASSERT_TRUE(model) << model.error().message;
  EXPECT_THAT(model->colors, IsEmpty());
  EXPECT_THAT(model->warnings, ElementsAre(HasSubstr("colours of faces")));
}

Result<Model> import_obj(const std::string& text) { return import_model(to_bytes(text), ModelFormat::obj); }

TEST(ObjColors, OfRealsAndOfBytes_AreRead) {
  for (const char* const text : {"v 0 0 0 1 0 0\nv 1 0 0 0 .2 0\nv 0 1 0 1 1 1\nf 1 2 3\n",
                                 "v 0 0 0 1 0 0 0.5\nv 1 0 0 0 .2 0 1\nv 0 1 0 1 1 1 0\nf 1 2 3\n",
                                 "v 0 0 0 255 0 0\nv 1 0 0 0 51 0\nv 0 1 0 255 255 255\nf 1 2 3\n"}) {
    const auto model = import_obj(text);
    ASSERT_TRUE(model) << model.error().message;
    EXPECT_THAT(model->colors, ElementsAre(red, Color8{0, 51, 0}, white)) << text;
    EXPECT_THAT(model->warnings, IsEmpty());
  }
}

TEST(ObjColors, OfOnePart_LeaveTheOtherItsMaterial) {
  const auto model = import_obj(
      "v 0 0 0\nv 1 0 0 1\nv 0 1 0\nv 0 0 1 1 0 0\nv 1 0 1 1 0 0\nv 0 1 1 1 0 0 # red\nv 9 9 9\n"
      "g plain\nf 1 2 3\ng red\nf 4 5 6\n");
  ASSERT_TRUE(model) << model.error().message;
  EXPECT_THAT(model->colors, ElementsAre(white, white, white, red, red, red, white));
  EXPECT_FALSE(model->primitives[0].has_colors);
  EXPECT_TRUE(model->primitives[1].has_colors);
}

TEST(ObjColors, ReplaceTheColorOfAMaterial_ButNotAnImage) {
  const import::ResourceReader resources = [](std::string_view name, std::size_t) -> Result<Bytes> {
    if (name == "a.mtl") return to_bytes("newmtl grey\nKd .5 .5 .5\nnewmtl photo\nKd 1 1 1\nmap_Kd a.png\n");
    return png_of(4, 4);
  };
  const std::string vertices = "mtllib a.mtl\nv 0 0 0 1 0 0\nv 1 0 0 1 0 0\nv 0 1 0 1 0 0\nv 1 1 0\nv 2 1 0\nv 1 2 0\n";
  const auto model = import_model(to_bytes(vertices + "usemtl grey\nf 1 2 3\nf 1 3 2\ng plain\nf 4 5 6\n"),
                                  ModelFormat::obj, {}, resources);
  ASSERT_TRUE(model) << model.error().message;
  ASSERT_EQ(model->primitives.size(), 2U);
  const auto color_of = [&](std::size_t p) {
    return glm::vec3(model->materials[static_cast<std::size_t>(model->primitives[p].material)].base_color);
  };
  EXPECT_EQ(color_of(0), glm::vec3(1.0F));
  EXPECT_EQ(color_of(1), glm::vec3(0.5F)) << "of the vertices without colours";

  const auto photo = import_model(to_bytes(vertices + "usemtl photo\nf 1 2 3\n"), ModelFormat::obj, {}, resources);
  ASSERT_TRUE(photo) << photo.error().message;
  ASSERT_EQ(photo->images.size(), 1U);
  EXPECT_THAT(photo->colors, IsEmpty());
}

TEST(ObjColors, ThatAreNoNumbers_AreWhite_WithAWarning) {
  const auto model = import_obj("v 0 0 0 1 0 0\nv 1 0 0 0 green 0\nv 0 1 0 nan 0 0\nf 1 2 3\n");
  ASSERT_TRUE(model) << model.error().message;
  EXPECT_THAT(model->colors, ElementsAre(red, white, white));
  EXPECT_THAT(model->warnings, ElementsAre("2 vertices have a colour that is not three numbers: they are white"));
}

class GltfColors : public ::testing::Test {
 protected:
  GltfColors() { writer.add_quad(); }

  void set(const Bytes& bytes, Component component, const char* type, bool normalized) {
    writer.primitive()["attributes"]["COLOR_0"] = writer.accessor(writer.view(bytes), component, 4, type, normalized);
  }

  GltfWriter writer;
};

TEST_F(GltfColors, AreLinear) {
  // Half the light of sRGB is 188 of 255.
  set(bytes_of<float>({1, 0, 0, 0.5F, 0.5F, 0.5F, 1, 1, 1, 0, 1, 0}), f32, "VEC3", false);
  const auto floats = writer.import();
  ASSERT_TRUE(floats) << floats.error().message;
  EXPECT_THAT(floats->colors, ElementsAre(red, Color8{188, 188, 188}, white, Color8{0, 255, 0}));
  EXPECT_TRUE(floats->primitives[0].has_colors);
  EXPECT_THAT(floats->warnings, IsEmpty());

  const std::vector<std::uint16_t> shorts = {65535, 0,     0,     9, 32768, 32768, 32768, 9,
                                             65535, 65535, 65535, 9, 0,     65535, 0,     9};
  for (const bool normalized : {true, false}) {
    set(bytes_of(shorts), u16, "VEC4", normalized);
    const auto model = writer.import();
    ASSERT_TRUE(model) << model.error().message;
    EXPECT_EQ(model->colors, floats->colors) << normalized;
  }
}

TEST_F(GltfColors, OnlyWhiteOnes_AreNone) {
  set(Bytes(16, 255), u8, "VEC4", true);
  const auto model = writer.import();
  ASSERT_TRUE(model) << model.error().message;
  EXPECT_THAT(model->colors, IsEmpty());
}

TEST_F(GltfColors, OfOnePrimitive_LeaveTheOtherWhite) {
  const nlohmann::json plain = writer.primitive();
  set(Bytes(12, 0x80), u8, "VEC3", true);
  writer.json["meshes"][0]["primitives"].insert(writer.json["meshes"][0]["primitives"].begin(), plain);
  const auto model = writer.import();
  ASSERT_TRUE(model) << model.error().message;
  ASSERT_EQ(model->primitives.size(), 2U);
  EXPECT_FALSE(model->primitives[0].has_colors);
  EXPECT_TRUE(model->primitives[1].has_colors);
  const Color8 grey = {188, 188, 188};
  EXPECT_THAT(model->colors, ElementsAre(white, white, white, white, grey, grey, grey, grey));
}

TEST_F(GltfColors, OutOfRange_AreClamped) {
  set(bytes_of<float>({7, -3, 0, std::numeric_limits<float>::quiet_NaN(), 1, 1, 1, 1, 1, 0, 0, 0}), f32, "VEC3", false);
  const auto model = writer.import();
  ASSERT_TRUE(model) << model.error().message;
  EXPECT_THAT(model->colors, ElementsAre(red, Color8{}, white, Color8{}));
}

TEST_F(GltfColors, OfAnotherCountOrShape_AreRefused) {
  set(Bytes(16, 9), u8, "VEC2", true);
  const auto shape = writer.import();
  ASSERT_FALSE(shape);
  EXPECT_THAT(shape.error().message, HasSubstr("must have 3 components"));
  writer.primitive()["attributes"]["COLOR_0"] = writer.accessor(writer.view(Bytes(12, 9)), u8, 3, "VEC4", true);
  const auto count = writer.import();
  ASSERT_FALSE(count);
  EXPECT_THAT(count.error().message, HasSubstr("is 3, but must be 4"));
}

}  // namespace
}  // namespace semblante::test
