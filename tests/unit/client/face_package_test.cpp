#include "clients/native/client/face_package.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include <draco/compression/expert_encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <gtest/gtest.h>
#include <openssl/evp.h>

#include "clients/runtime/face_mesh.h"
#include "protocol/cpp/weights_format.h"

namespace semblante::testing {
namespace {

using client::Face;
using client::PackageBytes;
using runtime::decode_mesh;

Sha256 hash_of(const std::string& bytes) {
  Sha256 hash{};
  unsigned size = 0;
  EVP_Digest(bytes.data(), bytes.size(), hash.data(), &size, EVP_sha256(), nullptr);
  return hash;
}

/// Two triangles that share an edge, and a package around them in which 2.1 moves every vertex whole.
struct Square {
  RigDocument rig;
  InfluenceTable table;
  PackageBytes bytes;

  explicit Square(const std::array<float, 3>& corner = {1, 1, 0}) {
    draco::TriangleSoupMeshBuilder builder;
    builder.Start(2);
    const int position = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
    const std::array<float, 3> a = {0, 0, 0};
    const std::array<float, 3> b = {1, 0, 0};
    const std::array<float, 3> d = {0, 1, 0};
    builder.SetAttributeValuesForFace(position, draco::FaceIndex(0), a.data(), b.data(), corner.data());
    builder.SetAttributeValuesForFace(position, draco::FaceIndex(1), a.data(), corner.data(), d.data());
    const std::unique_ptr<draco::Mesh> mesh = builder.Finalize();
    draco::ExpertEncoder encoder(*mesh);
    draco::EncoderBuffer buffer;
    EXPECT_TRUE(encoder.EncodeToBuffer(&buffer).ok());
    bytes.mesh_drc.assign(buffer.data(), buffer.size());
    rig.name = "square";
    rig.mesh.vertices = 4;
    rig.mesh.triangles = 2;
    rig.mesh.attributes.position = mesh->attribute(position)->unique_id();
    rig.fapu.value[static_cast<std::size_t>(FapuUnit::mns)] = 0.01;
    rig.materials.emplace_back();
    table.vertex_count = 4;
    for (int v = 0; v < 4; ++v) {
      table.rows.push(*parse_feature_point("2.1"), 1.0F);
      table.rows.end_row();
    }
    table.rigid.assign(4, 0);
    seal();
  }

  /// Hashes and documents after a change.
  void seal() {
    rig.mesh.sha256 = hash_of(bytes.mesh_drc);
    rig.mesh.bytes = bytes.mesh_drc.size();
    table.mesh_sha256 = rig.mesh.sha256;
    const auto weights = encode_weights(table);
    bytes.weights.assign(weights.begin(), weights.end());
    rig.weights.sha256 = hash_of(bytes.weights);
    rig.weights.bytes = bytes.weights.size();
    bytes.rig_json = write_rig(rig);
  }
};

std::span<const std::uint8_t> as_bytes(const std::string& text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

TEST(FacePackage, ThatDoesNotHoldTogether_IsRefused) {
  const auto expect_refused = [](const char* what, ErrorCode code, const std::function<void(Square&)>& spoil) {
    Square square;
    spoil(square);
    const auto face = Face::create(square.bytes);
    ASSERT_FALSE(face) << what;
    EXPECT_EQ(face.error().code, code) << what << ": " << face.error().message;
  };
  expect_refused("weights of another mesh", ErrorCode::mismatch, [](Square& s) {
    s.table.mesh_sha256[0] ^= 1U;
    const auto weights = encode_weights(s.table);
    s.bytes.weights.assign(weights.begin(), weights.end());
    s.rig.weights.sha256 = hash_of(s.bytes.weights);
    s.bytes.rig_json = write_rig(s.rig);
  });
  expect_refused("another mesh", ErrorCode::mismatch, [](Square& s) {
    s.bytes.mesh_drc = Square({2, 1, 0}).bytes.mesh_drc;
  });
  expect_refused("a bit of the weights", ErrorCode::mismatch, [](Square& s) { s.bytes.weights.back() ^= 1; });
  expect_refused("a rig that announces more vertices", ErrorCode::mismatch, [](Square& s) {
    s.rig.mesh.vertices = 5;
    s.bytes.rig_json = write_rig(s.rig);
  });
  expect_refused("a rig that is none", ErrorCode::malformed, [](Square& s) { s.bytes.rig_json = "[]"; });
  expect_refused("a position that is no number", ErrorCode::not_finite, [](Square& s) {
    s = Square({std::nanf(""), 1, 0});
  });
}

TEST(FacePackage, OfASquare_TakesFrames) {
  const Square square;
  auto face = Face::create(square.bytes);
  ASSERT_TRUE(face) << face.error().where << face.error().message;
  EXPECT_EQ(face->model().triangles.size(), 2U);
  const std::vector<glm::vec3> rest = face->positions();
  semblante_frame frame{};
  frame.fap[3] = 50;  // open_jaw: down by 50 * MNS = 0.5
  ASSERT_EQ(semblante_head_set_frame(face->head(), &frame), SEMBLANTE_OK);
  const std::vector<glm::vec3> posed = face->positions();
  for (std::size_t v = 0; v < 4; ++v) {
    EXPECT_NEAR(posed[v].y, rest[v].y - 0.5F, 1e-6F);
  }
}

TEST(DecodeMesh, AnyCutOrFlippedBit_NeverGivesIndicesOutOfRange) {
  const Square square;
  for (std::size_t size = 0; size < square.bytes.mesh_drc.size(); ++size) {
    EXPECT_FALSE(decode_mesh(as_bytes(square.bytes.mesh_drc).first(size), square.rig.mesh)) << size;
  }
  int decoded = 0;
  for (std::size_t bit = 0; bit < square.bytes.mesh_drc.size() * 8; ++bit) {
    std::string bytes = square.bytes.mesh_drc;
    bytes[bit / 8] = static_cast<char>(static_cast<unsigned char>(bytes[bit / 8]) ^ (1U << (bit % 8)));
    const auto mesh = decode_mesh(as_bytes(bytes), square.rig.mesh);
    if (mesh) {
      ++decoded;
      ASSERT_EQ(mesh->positions.size(), 4U);
      for (const Triangle& triangle : mesh->triangles) {
        EXPECT_LT(std::max({triangle[0], triangle[1], triangle[2]}), 4U) << bit;
      }
    }
  }
  // Draco has no checksum: flips in the numbers themselves go through, which is why hashes are compared first.
  EXPECT_GT(decoded, 0);
}

TEST(DecodeMesh, AnnouncedBeyondTheLimit_IsRefusedUnread) {
  const Square square;
  RigDocument::Mesh mesh = square.rig.mesh;
  mesh.vertices = 5'000'000;
  EXPECT_EQ(decode_mesh(as_bytes(square.bytes.mesh_drc), mesh).error().code, ErrorCode::too_large);
  mesh.vertices = 0;
  EXPECT_EQ(decode_mesh(as_bytes(square.bytes.mesh_drc), mesh).error().code, ErrorCode::empty);
}

}  // namespace
}  // namespace semblante::testing
