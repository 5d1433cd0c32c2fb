#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "core/draco/draco_encode.h"
#include "core/draco/draco_header.h"
#include "core/draco/draco_mesh.h"

namespace semblante {
namespace {

struct Grid {
  std::vector<glm::vec3> positions;
  std::vector<std::uint32_t> numbers;
  std::vector<Triangle> triangles;
};

/// A flat square of `side` by `side` cells: what Draco makes smallest.
Grid grid(std::uint32_t side) {
  Grid out;
  const std::uint32_t row = side + 1;
  for (std::uint32_t i = 0; i < row * row; ++i) {
    out.positions.emplace_back(static_cast<float>(i % row), static_cast<float>(i / row), 0.0F);
    out.numbers.push_back(i);
  }
  for (std::uint32_t y = 0; y < side; ++y) {
    for (std::uint32_t x = 0; x < side; ++x) {
      const std::uint32_t a = y * row + x;
      out.triangles.push_back({a, a + 1, a + row + 1});
      out.triangles.push_back({a, a + row + 1, a + row});
    }
  }
  return out;
}

std::vector<std::uint8_t> encoded(const Grid& grid, int position_bits = 14) {
  using Kind = DracoAttribute::Kind;
  using Type = DracoAttribute::Type;
  const std::array<DracoAttribute, 2> attributes = {
      {{Kind::position, Type::float32, 3, std::as_bytes(std::span(grid.positions)), {}, position_bits},
       {Kind::generic, Type::uint32, 1, std::as_bytes(std::span(grid.numbers)), {}, 0}}};
  auto bytes = encode_draco(grid.positions.size(), grid.triangles, attributes, 0);
  EXPECT_TRUE(bytes);
  return bytes ? *bytes : std::vector<std::uint8_t>{};
}

TEST(Draco, Mesh_ComesBack_WithItsVertexNumbers) {
  const Grid in = grid(4);
  const auto out = DracoMesh::decode(encoded(in));
  ASSERT_TRUE(out) << out.error().message;
  ASSERT_EQ(out->triangle_count(), in.triangles.size());
  const auto positions = out->vectors3(0);
  const auto numbers = out->numbers(1);
  ASSERT_TRUE(positions && numbers);
  for (std::size_t v = 0; v < positions->size(); ++v) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR((*positions)[v][c], in.positions[(*numbers)[v]][c], 2e-4);
  }
  EXPECT_EQ(out->vectors3(9).error().code, ErrorCode::missing);
  EXPECT_EQ(out->vectors2(0).error().code, ErrorCode::mismatch);
  EXPECT_EQ(out->bytes(0).error().code, ErrorCode::mismatch);
}

/// The bound of faces a byte must not refuse the most regular mesh.
TEST(Draco, FlatGrid_AtItsSmallest_IsPlausible) {
  Grid flat = grid(500);
  flat.numbers.assign(flat.numbers.size(), 0);
  const auto bytes = encoded(flat);
  const auto out = DracoMesh::decode(bytes);
  ASSERT_TRUE(out) << out.error().message;
  EXPECT_LT(flat.triangles.size() / bytes.size(), 32U);
}

TEST(Draco, MoreThanTheLimits_IsRefused) {
  const auto bytes = encoded(grid(4));
  EXPECT_TRUE(DracoMesh::decode(bytes, {25, 32}));
  EXPECT_EQ(DracoMesh::decode(bytes, {24, 32}).error().code, ErrorCode::too_large);
  EXPECT_EQ(DracoMesh::decode(bytes, {25, 31}).error().code, ErrorCode::too_large);
}

TEST(Draco, NumberThatIsNotFinite_IsRefused) {
  Grid in = grid(2);
  in.positions[3].x = std::nanf("");
  const auto out = DracoMesh::decode(encoded(in, 0));
  ASSERT_TRUE(out) << out.error().message;
  EXPECT_EQ(out->vectors3(0).error().code, ErrorCode::not_finite);
}

TEST(Draco, EveryPrefix_IsRefused_OrReadWithoutCrashing) {
  const auto bytes = encoded(grid(6));
  std::size_t refused = 0;
  for (std::size_t n = 0; n < bytes.size(); ++n) {
    refused += DracoMesh::decode(std::span(bytes).first(n)) ? 0 : 1;
  }
  // Draco has no checksum: the last few bytes may be slack, nearly all prefixes must be noticed.
  EXPECT_GT(refused, bytes.size() * 9 / 10);
}

TEST(DracoHeader, GivesTheCounts) {
  const Grid in = grid(4);
  const auto counts = announced_counts(encoded(in));
  ASSERT_TRUE(counts) << counts.error().message;
  EXPECT_EQ(counts->points, in.positions.size());
  EXPECT_EQ(counts->faces, in.triangles.size());
}

}  // namespace
}  // namespace semblante
