// EXT_meshopt_compression: streams made by the library's own encoder, and streams nobody should have made.
#include "core/import/gltf_meshopt.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <meshoptimizer.h>

#include <gtest/gtest.h>

#include "tests/unit/import/compressed_quads.h"

namespace semblante::test {
namespace {

TEST(Meshopt, Quad_ComesOutAsWritten_AsTrianglesAndAsIndices) {
  for (const bool as_triangles : {true, false}) {
    const auto model = compressed_quad(as_triangles).import();
    ASSERT_TRUE(model) << model.error().where << " " << model.error().message;
    EXPECT_EQ(model->positions, (std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
    ASSERT_EQ(model->triangles.size(), 2U);
    // The codec may turn a triangle's corners round, never over.
    for (Triangle t : model->triangles) {
      std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
      EXPECT_LT(t[1], t[2]) << "wound as written";
    }
    EXPECT_NEAR(model->normals[2].y, 0.6F, 0.02F);
    EXPECT_NEAR(model->normals[2].z, 0.8F, 0.02F);
    EXPECT_NEAR(model->normals[3].x, -0.48F, 0.02F);
    EXPECT_NEAR(model->normals[3].z, -0.64F, 0.02F);
    EXPECT_TRUE(model->warnings.empty());
  }
}

// The encoder of four vectors: newer versions than Debian 12's also want to be told which components share an exponent.
template <class... Mode>
void encode_exponential(void (*encode)(void*, std::size_t, std::size_t, int, const float*, Mode...),
                        std::vector<std::uint32_t>& encoded, const std::vector<float>& positions) {
  encode(encoded.data(), 4, 12, 24, positions.data(), Mode{}...);
}

TEST(Meshopt, ExponentialFilter_GivesFloats) {
  const std::vector<float> positions = {0, 0, 0, 1, 0, 0, 1, 1024.5F, 0, 0, 1, -0.0078125F};
  std::vector<std::uint32_t> encoded(12);
  encode_exponential(meshopt_encodeFilterExp, encoded, positions);
  GltfWriter writer;
  writer.add_quad();
  writer.json["buffers"] = {nlohmann::json::object(), {{"byteLength", 256}}};
  writer.primitive()["attributes"]["POSITION"] = writer.accessor(
      compressed_view(writer, encoded_vertices(encoded, 12), 4, 12, "ATTRIBUTES", "EXPONENTIAL"), f32, 4, "VEC3");
  const auto model = writer.import();
  ASSERT_TRUE(model) << model.error().where << " " << model.error().message;
  for (std::size_t i = 0; i < 12; ++i) {
    EXPECT_NEAR(model->positions[i / 3][static_cast<int>(i % 3)], positions[i], 1e-3F * (1 + std::abs(positions[i])));
  }
}

TEST(Meshopt, QuaternionFilter_DecodesToUnitQuaternions) {
  const std::vector<float> rotations = {0, 0, 0, 1, 0.5F, 0.5F, 0.5F, 0.5F};
  std::vector<std::int16_t> encoded(8);
  meshopt_encodeFilterQuat(encoded.data(), 2, 8, 16, rotations.data());
  import::MeshoptLayout layout;
  layout.filter = import::MeshoptLayout::Filter::quaternion;
  layout.count = 2;
  layout.stride = 8;
  const auto decoded = import::decode_meshopt(encoded_vertices(encoded, 8), layout, 1 << 20);
  ASSERT_TRUE(decoded) << decoded.error().message;
  std::array<std::int16_t, 8> values{};
  std::memcpy(values.data(), decoded->data(), sizeof values);
  for (std::size_t i = 0; i < 8; ++i) EXPECT_NEAR(static_cast<float>(values[i]) / 32767.0F, rotations[i], 1e-3F);
}

TEST(Meshopt, WrongLayouts_AreRefused_BeforeTheLibrarySeesThem) {
  const auto refused = [](const std::function<void(nlohmann::json&)>& change, std::size_t view = 0) {
    GltfWriter writer = compressed_quad(true);
    change(writer.json["bufferViews"][view]["extensions"]["EXT_meshopt_compression"]);
    const auto model = writer.import();
    return model ? std::string("read") : model.error().where;
  };
  const std::string extension = "/bufferViews/0/extensions/EXT_meshopt_compression";
  EXPECT_EQ(refused([](auto&) {}), "read");
  EXPECT_EQ(refused([](auto& e) { e["count"] = 4'000'000'000U; }), extension);
  EXPECT_EQ(refused([](auto& e) { e["count"] = 100'000; }), extension);
  EXPECT_EQ(refused([](auto& e) { e["count"] = 300; }), extension) << "more than the stream has";
  EXPECT_EQ(refused([](auto& e) { e["count"] = 3; }), "/bufferViews/0/byteLength");
  EXPECT_EQ(refused([](auto& e) { e["count"] = -1; }), extension + "/count");
  EXPECT_EQ(refused([](auto& e) { e["byteStride"] = 0; }), extension + "/byteStride");
  EXPECT_EQ(refused([](auto& e) { e["byteStride"] = 10; }), extension + "/byteStride");
  EXPECT_EQ(refused([](auto& e) { e["byteStride"] = 1024; }), extension + "/byteStride");
  EXPECT_EQ(refused([](auto& e) { e["byteLength"] = 1'000'000; }), extension);
  EXPECT_EQ(refused([](auto& e) { e["byteOffset"] = 1'000'000; }), extension);
  EXPECT_EQ(refused([](auto& e) { e["buffer"] = 7; }), extension + "/buffer");
  EXPECT_EQ(refused([](auto& e) { e["buffer"] = 1; }), "/buffers/1") << "the fallback is not there";
  EXPECT_EQ(refused([](auto& e) { e["mode"] = "ZIP"; }), extension + "/mode");
  EXPECT_EQ(refused([](auto& e) { e["mode"] = "TRIANGLES"; }), extension);
  EXPECT_EQ(refused([](auto& e) { e["filter"] = "QUATERNION"; }), extension) << "stride 12";
  EXPECT_EQ(refused([](auto& e) { e["filter"] = "COLOR"; }), extension + "/filter");
  const std::string indices = "/bufferViews/2/extensions/EXT_meshopt_compression";
  EXPECT_EQ(refused([](auto& e) { e["count"] = 5; }, 2), indices) << "no whole triangles";
  EXPECT_EQ(refused([](auto& e) { e["byteStride"] = 3; }, 2), indices);
  EXPECT_EQ(refused([](auto& e) { e["filter"] = "OCTAHEDRAL"; }, 2), indices);
}

TEST(Meshopt, DecodedBytes_CountAgainstTheLimit) {
  // 256 times 64 kB of zeros in a few bytes each: refused before they are made.
  const std::vector<float> zeros(64 * 1024, 0.0F);
  const Bytes encoded = encoded_vertices(zeros, 256);
  import::MeshoptLayout layout;
  layout.count = zeros.size() * 4 / 256;
  layout.stride = 256;
  EXPECT_TRUE(import::decode_meshopt(encoded, layout, zeros.size() * 4));
  const auto refused = import::decode_meshopt(encoded, layout, zeros.size() * 4 - 1);
  ASSERT_FALSE(refused);
  EXPECT_EQ(static_cast<int>(refused.error().code), static_cast<int>(ErrorCode::too_large));
}

TEST(Meshopt, Stream_CutAnywhere_IsRefused) {
  const std::vector<float> positions = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
  const Bytes vertices = encoded_vertices(positions, 12);
  const Bytes triangles = encoded_triangles({0, 1, 2, 0, 2, 3}, 4);
  import::MeshoptLayout layout;
  const auto expect_refused = [&layout](const Bytes& whole) {
    for (std::size_t size = 0; size < whole.size(); ++size) {
      const Bytes prefix(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
      EXPECT_FALSE(import::decode_meshopt(prefix, layout, 1 << 20)) << size;
    }
  };
  layout.count = 4;
  layout.stride = 12;
  expect_refused(vertices);
  layout.mode = import::MeshoptLayout::Mode::triangles;
  layout.count = 6;
  layout.stride = 4;
  expect_refused(triangles);
}

}  // namespace
}  // namespace semblante::test
