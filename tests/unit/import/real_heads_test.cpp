#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <ostream>
#include <set>
#include <span>
#include <string>

#include <gtest/gtest.h>

#include "core/import/import.h"

namespace semblante {
namespace {

std::filesystem::path faces_directory() {
  if (const char* const set = std::getenv("SEMBLANTE_FACES_DIR")) return set;
  return std::filesystem::path(SEMBLANTE_SOURCE_DIR).parent_path() / "shared" / "faces";
}

/// Reads a head and detects its format; the head must be there.
Result<Model> import_head(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const std::span bytes(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
  const auto format = detect_format(bytes, path.filename().string());
  if (!format) return Error{ErrorCode::malformed, "", "no format detected"};
  return import_model(bytes, *format);
}

struct Expected {
  const char* file;
  std::size_t vertices;
  std::size_t triangles;
};
void PrintTo(const Expected& expected, std::ostream* out) { *out << expected.file; }

class RealHeads : public ::testing::TestWithParam<Expected> {};

TEST_P(RealHeads, Counts_AreThoseOfTheFile) {
  const auto path = faces_directory() / GetParam().file;
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "no " << path;
  const auto model = import_head(path);
  ASSERT_TRUE(model) << model.error().where << ": " << model.error().message;
  EXPECT_EQ(model->positions.size(), GetParam().vertices);
  EXPECT_EQ(model->triangles.size(), GetParam().triangles);
}

INSTANTIATE_TEST_SUITE_P(All, RealHeads,
                         ::testing::Values(Expected{"ict-facekit/neutral.obj", 26719, 52220},
                                           Expected{"makehuman/head.obj", 5060, 9844},
                                           Expected{"makehuman/head.glb", 5295, 9844},
                                           Expected{"mediapipe-canonical/canonical_face_model.obj", 468, 898},
                                           Expected{"mediapipe-canonical/face_model_with_iris.obj", 478, 906}));

TEST(RealHeads, MorphTargets_OfAllMeshes_AreExamplesByName) {
  const auto path = faces_directory() / "makehuman" / "head.glb";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "no " << path;
  const auto model = import_head(path);
  ASSERT_TRUE(model);
  EXPECT_EQ(model->examples.size(), 19U);
  for (const Example& example : model->examples) {
    EXPECT_FALSE(example.vertices.empty()) << example.name;
    EXPECT_TRUE(std::is_sorted(example.vertices.begin(), example.vertices.end())) << example.name;
    EXPECT_EQ(example.vertices.size(), example.displacements.size()) << example.name;
    EXPECT_LT(example.vertices.size(), model->positions.size()) << example.name;
  }
}

/// makehuman's GLB was made from its OBJ by fans, so the two must have the same triangles, corner by corner: an own
/// way of splitting quads would give every weight other edges.
TEST(RealHeads, Triangles_OfGlbAndObj_AreAtTheSamePlaces) {
  const auto folder = faces_directory() / "makehuman";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no " << folder;
  const auto obj = import_head(folder / "head.obj");
  const auto glb = import_head(folder / "head.glb");
  ASSERT_TRUE(obj && glb);
  const auto places = [](const Model& model) {
    std::multiset<std::array<float, 9>> all;
    for (const Triangle& t : model.triangles) {
      std::array<float, 9> place{};
      for (std::size_t c = 0; c < 3; ++c) {
        for (int axis = 0; axis < 3; ++axis) {
          place[3 * c + static_cast<std::size_t>(axis)] = model.positions[t[c]][axis];
        }
      }
      all.insert(place);
    }
    return all;
  };
  EXPECT_EQ(places(*obj), places(*glb));
}

}  // namespace
}  // namespace semblante
