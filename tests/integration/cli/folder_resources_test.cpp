// A model file on disk brings the files beside it, and no others.
#include <cstring>
#include <filesystem>

#include <gtest/gtest.h>

#include "tests/integration/cli/program.h"

namespace semblante::test {
namespace {

namespace fs = std::filesystem;

/// Four corners of a square and two triangles, as a glTF's buffer: 48 bytes of positions, 12 of indices.
std::string square_buffer() {
  const float positions[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
  const std::uint16_t indices[] = {0, 1, 2, 0, 2, 3};
  std::string bytes(sizeof positions + sizeof indices, '\0');
  std::memcpy(bytes.data(), positions, sizeof positions);
  std::memcpy(bytes.data() + sizeof positions, indices, sizeof indices);
  return bytes;
}

std::string square_gltf(const std::string& uri) {
  return R"({"asset":{"version":"2.0"},"buffers":[{"uri":")" + uri + R"(","byteLength":60}],
    "bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":12}],
    "accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},
                 {"bufferView":1,"componentType":5123,"count":6,"type":"SCALAR"}],
    "meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],
    "nodes":[{"mesh":0}],"scenes":[{"nodes":[0]}],"scene":0})";
}

struct FolderResources : ::testing::Test {
  Workspace work;

  void SetUp() override {
    fs::create_directories(work.path("head/buffers"));
    (void)work.write("secret.bin", square_buffer());
  }
  [[nodiscard]] static Outcome examine(const std::string& model) { return run_semblante({"examine", model}); }
};

TEST_F(FolderResources, Gltf_ReadsItsBuffer_BesideItAndBelowIt) {
  (void)work.write("head/buffers/a b.bin", square_buffer());
  const Outcome below = examine(work.write("head/below.gltf", square_gltf("buffers/a%20b.bin")));
  EXPECT_EQ(below.err.find("/buffers/0"), std::string::npos) << below.err;
  EXPECT_NE(below.exit_code, 2) << below.err;
  (void)work.write("head/beside.bin", square_buffer());
  const Outcome beside = examine(work.write("head/beside.gltf", square_gltf("beside.bin")));
  EXPECT_NE(beside.exit_code, 2) << beside.err;
}

TEST_F(FolderResources, PathsOutOfTheFolder_AreRefused) {
  fs::create_symlink("../secret.bin", work.path("head/link.bin"));
  for (const std::string& uri : {std::string("../secret.bin"), work.path("secret.bin"), std::string("link.bin"),
                                 std::string("missing.bin"), std::string("buffers"), std::string("file:secret.bin")}) {
    const Outcome outcome = examine(work.write("head/head.gltf", square_gltf(uri)));
    EXPECT_EQ(outcome.exit_code, 2) << uri;
    EXPECT_NE(outcome.err.find("/buffers/0/uri: no file '"), std::string::npos) << uri << ": " << outcome.err;
    EXPECT_NE(outcome.err.find("in the folder of the model file"), std::string::npos) << uri << ": " << outcome.err;
  }
}

TEST_F(FolderResources, Obj_ReadsItsMaterials_AlsoByThePathOfAnotherMachine) {
  const std::string faces = "v 0 0 0\nv 1 0 0\nv 1 1 0\nusemtl skin\nf 1 2 3\n";
  (void)work.write("head/skin.mtl", "newmtl skin\nmap_Kd C:\\pictures\\missing.png\n");
  for (const std::string& name :
       {std::string("skin.mtl"), std::string("C:\\models\\skin.mtl"), std::string("/home/ana/skin.mtl")}) {
    const Outcome outcome = examine(work.write("head/head.obj", "mtllib " + name + "\n" + faces));
    // The material file was found: what is missing is the image that it names.
    EXPECT_NE(outcome.err.find("missing.png"), std::string::npos) << name << ": " << outcome.err;
    EXPECT_EQ(outcome.err.find("skin.mtl"), std::string::npos) << name << ": " << outcome.err;
  }
}

}  // namespace
}  // namespace semblante::test
