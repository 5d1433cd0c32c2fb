#include "clients/native/client/mesh_writer.h"

#include <cstring>
#include <limits>

#include <gtest/gtest.h>

#include "clients/native/client/kernel_frame.h"

namespace semblante::testing {
namespace {

using namespace std::string_literals;

Model triangle() {
  Model model;
  model.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  model.triangles = {{0, 1, 2}};
  model.uvs = {{0.25F, 0.75F}};
  model.uv_triangles = {{0, Model::no_index, 0}};
  model.primitives = {{"skin", -1, 0, 1}};
  return model;
}

TEST(MeshWriter, Obj_KeepsVertexOrderAndFlipsUvs) {
  const Model model = triangle();
  const std::vector<glm::vec3> posed = {{0.1F, -2, 3e-9F}, {1, 0, 0}, {0, 1, 0}};
  EXPECT_EQ(client::write_obj(model, posed),
            "# Semblante\nv 0.1 -2 3e-09\nv 1 0 0\nv 0 1 0\nvt 0.25 0.25\ng skin\nf 1/1 2 3/1\n");
}

TEST(MeshWriter, ObjGroupWithALineBreak_CannotWriteALine) {
  Model model = triangle();
  model.primitives[0].name = "a\nv 9 9 9";
  EXPECT_EQ(client::write_obj(model, model.positions).find("9 9 9"), std::string::npos);
}

TEST(MeshWriter, Ply_HasHeaderThenBytes) {
  const Model model = triangle();
  const std::string ply = client::write_ply(model, model.positions);
  const std::size_t body = ply.find("end_header\n") + 11;
  // 3 vertices of 12 bytes, 1 face of 1 + 3 * 4 bytes.
  ASSERT_EQ(ply.size() - body, 3U * 12 + 13);
  float x = 0;
  std::memcpy(&x, ply.data() + body + 12, 4);
  EXPECT_EQ(x, 1.0F);
  EXPECT_EQ(ply[body + 36], 3);
  EXPECT_NE(ply.find("element vertex 3\n"), std::string::npos);
  EXPECT_NE(ply.find("element face 1\n"), std::string::npos);
}

TEST(MeshWriter, Colors_FollowThePositions) {
  Model model = triangle();
  model.colors = {{255, 0, 51}, {0, 255, 0}, white};
  EXPECT_NE(client::write_obj(model, model.positions).find("v 0 0 0 1 0 0.2\nv 1 0 0 0 1 0\nv 0 1 0 1 1 1\n"),
            std::string::npos);
  const std::string ply = client::write_ply(model, model.positions);
  EXPECT_NE(ply.find("property uchar red\nproperty uchar green\nproperty uchar blue\nelement face"), std::string::npos);
  const std::size_t body = ply.find("end_header\n") + 11;
  ASSERT_EQ(ply.size() - body, 3U * 15 + 13);
  EXPECT_EQ(ply.substr(body + 12, 3), "\xFF\0\x33"s);
}

TEST(MeshWriter, Table_HasALineAVertex) {
  const std::vector<glm::vec3> posed = {{0.5F, -1, 2}};
  EXPECT_EQ(client::write_table(posed), "vertex,x,y,z\n0,0.5,-1,2\n");
}

TEST(KernelFrame, Levels_AreTimesTheStreamsSteps) {
  FaceFrame frame;
  frame.viseme = {1, 2, 63};
  frame.expression = {3, 4, 5, 6};
  frame.level[3] = -2;
  frame.level[68] = 7;
  QuantizerSteps steps{};
  steps[3] = 4;
  steps[68] = 0.5;
  const semblante_frame out = client::to_kernel_frame(frame, steps);
  EXPECT_EQ(out.viseme1, 1);
  EXPECT_EQ(out.viseme2, 2);
  EXPECT_EQ(out.viseme_blend, 63);
  EXPECT_EQ(out.expression1, 3);
  EXPECT_EQ(out.intensity1, 4);
  EXPECT_EQ(out.expression2, 5);
  EXPECT_EQ(out.intensity2, 6);
  EXPECT_EQ(out.fap[3], -8.0F);
  EXPECT_EQ(out.fap[68], 3.5F);
  EXPECT_EQ(out.fap[4], 0.0F);
}

}  // namespace
}  // namespace semblante::testing
