// `semblante deform --frames`: a mesh for each face of a file, and the paper's frames between them.
#include <cmath>
#include <filesystem>
#include <iterator>
#include <sstream>

#include <gtest/gtest.h>

#include "core/import/import.h"
#include "tests/integration/cli/program.h"

namespace semblante::test {
namespace {

namespace fs = std::filesystem;

/// A flat sheet of 5 by 5, one unit a step: vertex 5 * row + column.
std::string flat_sheet_obj() {
  std::ostringstream text;
  for (int v = 0; v < 25; ++v) text << "v " << v % 5 << " " << v / 5 << " 0\n";
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) {
      const int a = 5 * row + column + 1;
      text << "f " << a << " " << a + 1 << " " << a + 6 << " " << a + 5 << "\n";
    }
  }
  return text.str();
}

/// MNS0 is 9.15.y - 2.2.y = 1.
constexpr const char* flat_sheet_points = R"({"to_mpeg4_axes": [[1,0,0],[0,1,0],[0,0,1]],
  "points": {"9.15": {"vertex": 17}, "2.1": {"vertex": 2}, "2.2": {"vertex": 12}, "8.3": {"vertex": 14},
             "8.4": {"vertex": 10}}})";

/// FAP 3 opens by 1024 * value at frames 0, 1 and 4; frames 2 and 3 are left out.
std::string jaw_fap() {
  std::string mask;
  for (int fap = 1; fap <= 68; ++fap) mask.append(fap > 1 ? " " : "").append(fap == 3 ? "1" : "0");
  return "2.1 jaw 25 3\n" + mask + "\n0 0\n" + mask + "\n1 1024\n" + mask + "\n4 4096\n";
}

struct DeformFrames : ::testing::Test {
  Workspace work;
  std::string model = work.write("sheet.obj", flat_sheet_obj());
  std::string points = work.write("fps.json", flat_sheet_points);
  std::string fap = work.write("jaw.fap", jaw_fap());

  [[nodiscard]] Outcome deform(const std::string& out, std::vector<std::string> more) const {
    std::vector<std::string> arguments = {"deform", model,   "--feature-points", points, "--frames",
                                          fap,      "--out", work.path(out)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_semblante(arguments);
  }
  /// y of 2.1 in a mesh: FAP 3 moves it down.
  [[nodiscard]] double jaw(const std::string& out, const std::string& mesh,
                           ModelFormat format = ModelFormat::obj) const {
    const std::string text = read_text(fs::path(work.path(out)) / mesh);
    const auto model = import_model({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}, format);
    EXPECT_TRUE(model) << mesh;
    return model ? model->positions[2].y : NAN;
  }
  [[nodiscard]] std::size_t meshes(const std::string& out) const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(work.path(out)), fs::directory_iterator()));
  }
};

TEST_F(DeformFrames, WritesAMeshOfEachFrame_AlsoOfThoseLeftOut) {
  const Outcome outcome = deform("held", {});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  ASSERT_EQ(meshes("held"), 5U);
  const double expected[] = {0, -1, -1, -1, -4};
  for (int i = 0; i < 5; ++i) EXPECT_NEAR(jaw("held", "frame-0000" + std::to_string(i) + ".obj"), expected[i], 1e-5);
  ASSERT_EQ(deform("linear", {"--gaps", "interpolate"}).exit_code, 0);
  for (int i = 0; i < 5; ++i) EXPECT_NEAR(jaw("linear", "frame-0000" + std::to_string(i) + ".obj"), -i, 1e-5);
}

TEST_F(DeformFrames, FramesBetween_GoLinearly) {
  ASSERT_EQ(deform("between", {"--between", "3", "--to", "1", "--mesh-format", "ply"}).exit_code, 0);
  ASSERT_EQ(meshes("between"), 5U);
  for (int i = 0; i < 5; ++i) {
    EXPECT_NEAR(jaw("between", "frame-0000" + std::to_string(i) + ".ply", ModelFormat::ply), -0.25 * i, 1e-5) << i;
  }
}

TEST_F(DeformFrames, FromAndTo_AreFrameNumbers) {
  ASSERT_EQ(deform("some", {"--from", "3", "--to", "4"}).exit_code, 0);
  ASSERT_EQ(meshes("some"), 2U);
  EXPECT_NEAR(jaw("some", "frame-00000.obj"), -1, 1e-5);
  EXPECT_NEAR(jaw("some", "frame-00001.obj"), -4, 1e-5);
}

TEST_F(DeformFrames, WhatCannotBe_IsRefused) {
  EXPECT_NE(deform("x", {"--to", "5"}).err.find("--to: the last frame is 4"), std::string::npos);
  EXPECT_NE(deform("x", {"--from", "3", "--to", "2"}).err.find("--from"), std::string::npos);
  EXPECT_EQ(deform("x", {"--faps", "3=1"}).exit_code, 2);
  EXPECT_EQ(deform("x", {"--between", "-1"}).exit_code, 2);
  EXPECT_EQ(
      run_semblante({"deform", model, "--feature-points", points, "--between", "1", "--out", work.path("x")}).exit_code,
      2);
}

}  // namespace
}  // namespace semblante::test
