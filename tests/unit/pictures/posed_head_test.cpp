#include "tests/pictures/posed_head.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>

namespace semblante::pictures {
namespace {

TEST(LoadModel, ObjWithAMaterialFileBesideIt_HasItsColours) {
  std::string made = ::testing::TempDir() + "/semblante-head-XXXXXX";
  ASSERT_NE(mkdtemp(made.data()), nullptr);
  const std::filesystem::path folder = made;
  std::ofstream(folder / "head.mtl") << "newmtl skin\nKd 0.5 0.25 1\n";
  std::ofstream(folder / "head.obj") << "mtllib head.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl skin\nf 1 2 3\n";
  const auto head = load_model(folder / "head.obj");
  ASSERT_TRUE(head) << head.error().message;
  ASSERT_EQ(head->model.materials.size(), 1U);
  EXPECT_EQ(head->model.materials[0].name, "skin");
  std::filesystem::remove_all(folder);
}

TEST(WeightMethods, AreListedByName) { EXPECT_EQ(weight_method_list(), "paper, smooth, fitted"); }

}  // namespace
}  // namespace semblante::pictures
