// KHR_mesh_quantization: every component type it allows, checked against arithmetic done here.
#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "tests/unit/import/gltf_writer.h"

namespace semblante::test {
namespace {

struct Type {
  Component component;
  bool normalized;
};
void PrintTo(const Type& type, std::ostream* out) {
  *out << type.component << (type.normalized ? " normalized" : " as it is");
}

/// Integers of one type, each row padded to a multiple of 4 bytes as glTF asks of attributes.
template <class T>
std::size_t add_integers(GltfWriter& writer, Type type, const std::vector<std::array<T, 3>>& rows, int components) {
  const std::size_t stride = (static_cast<std::size_t>(components) * sizeof(T) + 3) / 4 * 4;
  Bytes bytes(rows.size() * stride);
  for (std::size_t i = 0; i < rows.size(); ++i)
    std::memcpy(bytes.data() + i * stride, rows[i].data(), static_cast<std::size_t>(components) * sizeof(T));
  return writer.accessor(writer.view(bytes, stride), type.component, rows.size(), components == 2 ? "VEC2" : "VEC3",
                         type.normalized);
}

template <class T>
float dequantized(T value, bool normalized) {
  if (!normalized) return static_cast<float>(value);
  return std::max(static_cast<float>(value) / static_cast<float>(std::numeric_limits<T>::max()), -1.0F);
}

template <class T>
void expect_read(Type type) {
  constexpr T low = std::numeric_limits<T>::min();
  constexpr T high = std::numeric_limits<T>::max();
  const std::vector<std::array<T, 3>> rows = {{low, 0, 1}, {high, 2, 3}, {high, high, 5}, {7, 100, low}};
  const std::vector<std::array<T, 3>> target = {{1, 2, 3}, {0, 0, 0}, {high, low, 0}, {0, 0, 0}};
  GltfWriter writer;
  writer.json["extensionsUsed"] = {"KHR_mesh_quantization"};
  writer.json["extensionsRequired"] = {"KHR_mesh_quantization"};
  auto& primitive = writer.primitive();
  primitive["attributes"]["POSITION"] = add_integers(writer, type, rows, 3);
  primitive["attributes"]["TEXCOORD_0"] = add_integers(writer, type, rows, 2);
  primitive["targets"] = {{{"POSITION", add_integers(writer, type, target, 3)}}};
  primitive["indices"] = writer.indices({0, 1, 2, 0, 2, 3});
  writer.json["nodes"][0]["scale"] = {0.5, 0.25, 2.0};
  writer.json["nodes"][0]["translation"] = {1, 0, -1};
  const auto model = writer.import();
  ASSERT_TRUE(model) << model.error().where << " " << model.error().message;
  const glm::vec3 scale(0.5F, 0.25F, 2.0F);
  const auto value = [&](const std::array<T, 3>& row) {
    return glm::vec3(dequantized(row[0], type.normalized), dequantized(row[1], type.normalized),
                     dequantized(row[2], type.normalized));
  };
  for (std::uint32_t i = 0; i < 4; ++i) {
    const glm::vec3 p = value(rows[i]) * scale + glm::vec3(1, 0, -1);
    const glm::vec3 d = value(target[i]) * scale;
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_FLOAT_EQ(model->positions[i][axis], p[axis]) << i;
      EXPECT_FLOAT_EQ(model->examples.at(0).at(i)[axis], d[axis]) << i;
    }
    EXPECT_EQ(model->uvs[i], glm::vec2(value(rows[i]))) << i;
  }
}

class Quantized : public ::testing::TestWithParam<Type> {};

TEST_P(Quantized, PositionsUvsAndTargets_AreTheirIntegers_MovedByTheNode) {
  switch (GetParam().component) {
    case i8:
      return expect_read<std::int8_t>(GetParam());
    case u8:
      return expect_read<std::uint8_t>(GetParam());
    case i16:
      return expect_read<std::int16_t>(GetParam());
    default:
      return expect_read<std::uint16_t>(GetParam());
  }
}

INSTANTIATE_TEST_SUITE_P(Gltf, Quantized,
                         ::testing::Values(Type{i8, false}, Type{i8, true}, Type{u8, false}, Type{u8, true},
                                           Type{i16, false}, Type{i16, true}, Type{u16, false}, Type{u16, true}));

TEST(QuantizedNormals, OfBytesAndShorts_AreUnitLength) {
  for (const Type type : {Type{i8, true}, Type{i16, true}}) {
    GltfWriter writer;
    writer.add_quad();
    writer.primitive()["attributes"]["NORMAL"] =
        type.component == i8
            ? add_integers<std::int8_t>(writer, type, {{0, 0, 127}, {0, -128, 0}, {90, 90, 0}, {0, 0, 0}}, 3)
            : add_integers<std::int16_t>(writer, type, {{0, 0, 32767}, {0, -32768, 0}, {23170, 23170, 0}, {0, 0, 0}},
                                         3);
    const auto model = writer.import();
    ASSERT_TRUE(model) << model.error().where << " " << model.error().message;
    EXPECT_EQ(model->normals[0], glm::vec3(0, 0, 1));
    EXPECT_EQ(model->normals[1], glm::vec3(0, -1, 0)) << "the least integer is -1, not less";
    EXPECT_NEAR(model->normals[2].x, std::sqrt(0.5F), 1e-4F);
    EXPECT_EQ(model->normal_triangles[1][2], Model::no_index) << "a normal of no direction is none";
  }
}

/// A material with a base colour and a normal map, each with its own KHR_texture_transform (null: none).
GltfWriter textured(const nlohmann::json& base, const nlohmann::json& normal) {
  GltfWriter writer;
  writer.add_quad();
  writer.primitive()["attributes"]["TEXCOORD_0"] = writer.floats({0, 0, 1, 0, 1, 1, 0, 1}, "VEC2");
  writer.primitive()["material"] = 0;
  const auto image = writer.view(png_of(4, 4));
  writer.json["images"] = {{{"bufferView", image}, {"mimeType", "image/png"}}};
  writer.json["textures"] = {{{"source", 0}}};
  const auto info = [](const nlohmann::json& transform) {
    nlohmann::json texture = {{"index", 0}};
    if (!transform.is_null()) texture["extensions"] = {{"KHR_texture_transform", transform}};
    return texture;
  };
  writer.json["materials"] = {
      {{"pbrMetallicRoughness", {{"baseColorTexture", info(base)}}}, {"normalTexture", info(normal)}}};
  return writer;
}

TEST(TextureTransform, OfTheBaseColour_IsInTheUvs) {
  const nlohmann::json transform = {{"offset", {0.5, 0.25}}, {"scale", {2, 4}}};
  const auto model = textured(transform, transform).import();
  ASSERT_TRUE(model) << model.error().message;
  EXPECT_EQ(model->uvs[2], glm::vec2(2.5F, 4.25F));
  EXPECT_EQ(model->materials[0].normal_image, 0);
  EXPECT_TRUE(model->warnings.empty());
}

TEST(TextureTransform, BeyondFloat32_IsRefused) {
  for (const double scale : {1e16, 1e39, -1e300}) {
    const auto model = textured({{"scale", {scale, 1}}}, nullptr).import();
    ASSERT_FALSE(model) << scale;
    EXPECT_EQ(static_cast<int>(model.error().code), static_cast<int>(ErrorCode::out_of_range));
    EXPECT_EQ(model.error().where, "texture coordinate 1");
  }
}

TEST(TextureTransform, NormalMapThatLiesOtherwise_IsLeftOut_WithAWarning) {
  const auto model = textured(nullptr, {{"scale", {2, 2}}}).import();
  ASSERT_TRUE(model) << model.error().message;
  EXPECT_EQ(model->materials[0].normal_image, -1);
  EXPECT_EQ(model->materials[0].base_color_image, 0);
  EXPECT_EQ(model->warnings.size(), 1U);
}

}  // namespace
}  // namespace semblante::test
