// A second reader nobody here wrote, on valid files: same vertices in the same order, same triangles.
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <tiny_gltf.h>

#include <gtest/gtest.h>

#include "deploy/sample_head/write_sample_head.h"
#include "tests/support/sample_shapes.h"
#include "tests/unit/import/test_files.h"

namespace semblante::test {
namespace {

struct Plain {
  std::vector<glm::vec3> positions;
  std::vector<Triangle> triangles;
};

/// Meshes and primitives in file order, float positions, indexed triangles, no node transforms.
Plain read_by_tinygltf(const Bytes& bytes) {
  tinygltf::TinyGLTF loader;
  loader.SetImageLoader([](tinygltf::Image*, int, std::string*, std::string*, int, int, const unsigned char*, int,
                           void*) { return true; },
                        nullptr);
  tinygltf::Model model;
  std::string error;
  std::string warning;
  EXPECT_TRUE(loader.LoadBinaryFromMemory(&model, &error, &warning, bytes.data(), static_cast<unsigned>(bytes.size())))
      << error;
  const auto data_of = [&model](const tinygltf::Accessor& accessor) {
    const tinygltf::BufferView& view = model.bufferViews[static_cast<std::size_t>(accessor.bufferView)];
    return model.buffers[static_cast<std::size_t>(view.buffer)].data.data() + view.byteOffset + accessor.byteOffset;
  };
  Plain plain;
  for (const tinygltf::Mesh& mesh : model.meshes) {
    for (const tinygltf::Primitive& primitive : mesh.primitives) {
      const auto first = static_cast<std::uint32_t>(plain.positions.size());
      const auto& positions = model.accessors[static_cast<std::size_t>(primitive.attributes.at("POSITION"))];
      for (std::size_t i = 0; i < positions.count; ++i) {
        std::array<float, 3> p{};
        std::memcpy(p.data(), data_of(positions) + i * sizeof p, sizeof p);
        plain.positions.emplace_back(p[0], p[1], p[2]);
      }
      const auto& indices = model.accessors[static_cast<std::size_t>(primitive.indices)];
      const std::size_t size = static_cast<std::size_t>(
          tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(indices.componentType)));
      for (std::size_t i = 0; i < indices.count; ++i) {
        std::uint32_t index = 0;
        std::memcpy(&index, data_of(indices) + i * size, size);
        if (i % 3 == 0) plain.triangles.emplace_back();
        plain.triangles.back()[i % 3] = first + index;
      }
    }
  }
  return plain;
}

void expect_same(const Bytes& bytes) {
  const auto ours = import_model(bytes, ModelFormat::glb);
  ASSERT_TRUE(ours) << ours.error().where << ": " << ours.error().message;
  const Plain theirs = read_by_tinygltf(bytes);
  EXPECT_EQ(ours->positions, theirs.positions);
  EXPECT_EQ(ours->triangles, theirs.triangles);
}

TEST(TinyGltf, Quad_IsReadTheSame) { expect_same(quad_glb()); }

TEST(TinyGltf, DracoQuad_IsReadTheSame) {
  expect_same(quad_draco_glb(false));
  expect_same(quad_draco_glb(true));
}

TEST(TinyGltf, SampleHead_IsReadTheSame) {
  const auto glb = sample_head_glb(make_sample_head());
  ASSERT_TRUE(glb);
  expect_same(*glb);
}

TEST(TinyGltf, Avatar_IsReadTheSame) { expect_same(testing::sample_avatar_glb()); }

TEST(TinyGltf, MakehumanHead_IsReadTheSame) {
  const char* const set = std::getenv("SEMBLANTE_FACES_DIR");
  const std::filesystem::path faces =
      set != nullptr ? std::filesystem::path(set)
                     : std::filesystem::path(SEMBLANTE_SOURCE_DIR).parent_path() / "shared" / "faces";
  const auto path = faces / "makehuman" / "head.glb";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "no " << path;
  std::ifstream file(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  expect_same(to_bytes(text));
}

}  // namespace
}  // namespace semblante::test
