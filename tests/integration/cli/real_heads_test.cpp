// The real program on whole heads: our own, always, and other people's where they are there.
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <set>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/import/import.h"
#include "core/tables/mpeg4.h"
#include "deploy/sample_head/write_sample_head.h"
#include "tests/integration/cli/program.h"
#include "tests/support/sample_obj.h"

namespace semblante::test {
namespace {

using nlohmann::json;

struct HeadFiles {
  std::string name;
  std::string model;
  std::string points;
};

std::filesystem::path faces_directory() {
  if (const char* const set = std::getenv("SEMBLANTE_FACES_DIR")) return set;
  return std::filesystem::path(SEMBLANTE_SOURCE_DIR).parent_path() / "shared" / "faces";
}

struct Heads : ::testing::Test {
  Workspace work;

  [[nodiscard]] HeadFiles of_our_own(const std::string& name, const SampleHeadTraits& traits = {}) const {
    const SampleHead head = make_sample_head(traits);
    const auto glb = sample_head_glb(head);
    EXPECT_TRUE(glb);
    return {name, work.write(name + ".glb", std::string(glb->begin(), glb->end())),
            work.write(name + ".fps.json", sample_head_feature_points_json(head))};
  }
  /// The sample, another person with pressed lips, a body, a scan, and whichever real heads there are.
  [[nodiscard]] std::vector<HeadFiles> all() const {
    std::vector<HeadFiles> heads = {
        of_our_own("sample"), of_our_own("other", {.jaw_width = 1.1, .face_length = 0.94, .pressed_lips = true}),
        of_our_own("body", {.form = SampleHeadForm::body}), of_our_own("scan", {.form = SampleHeadForm::scan})};
    const auto faces = faces_directory();
    for (const auto& [folder, model] :
         std::vector<std::pair<std::string, std::string>>{{"ict-facekit", "neutral.obj"},
                                                          {"makehuman", "head.obj"},
                                                          {"makehuman", "head.glb"},
                                                          {"mediapipe-canonical", "face_model_with_iris.obj"}}) {
      const auto path = faces / folder / model;
      if (std::filesystem::exists(path)) {
        heads.push_back({folder + "/" + model, path.string(), (faces / folder / (folder + ".fps.json")).string()});
      }
    }
    return heads;
  }
  [[nodiscard]] json weights_of(const HeadFiles& head) const {
    const std::string out = work.path("weights.json");
    const Outcome outcome =
        run_semblante({"parametrize", head.model, "--feature-points", head.points, "--weights-json", out});
    EXPECT_EQ(outcome.exit_code, 0) << head.name << ": " << outcome.err;
    return json::parse(read_text(out));
  }
  static Model import_file(const std::string& path) {
    const std::string text = read_text(path);
    const std::span bytes(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
    auto model = import_model(bytes, *detect_format(bytes, path));
    EXPECT_TRUE(model) << path;
    return model ? *model : Model{};
  }
};

/// Twenty points have one pair only, which is too little to show a tilt; with the proposals they show it.
TEST_F(Heads, Propose_OfATiltedHead_LeavesItsAxesToAllPoints) {
  const HeadFiles upright = of_our_own("sample");
  const glm::dmat3 tilt = glm::mat3_cast(glm::angleAxis(glm::radians(25.0), glm::normalize(glm::dvec3(0.2, 0.5, 1.0))));
  const Model model = import_file(upright.model);
  std::string obj;
  for (const glm::vec3& position : model.positions) {
    const glm::dvec3 p = tilt * glm::dvec3(position);
    obj += "v " + std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z) + "\n";
  }
  for (const Primitive& primitive : model.primitives) {
    obj += "o " + primitive.name + "\n";
    for (std::uint32_t t = 0; t < primitive.triangle_count; ++t) {
      const Triangle& triangle = model.triangles[primitive.first_triangle + t];
      obj += "f " + std::to_string(triangle[0] + 1) + " " + std::to_string(triangle[1] + 1) + " " +
             std::to_string(triangle[2] + 1) + "\n";
    }
  }
  const json all = json::parse(read_text(upright.points));
  json twenty = {{"points", json::object()}};
  for (const std::string_view id : mpeg4::quick_set)
    twenty["points"][std::string(id)] = {{"vertex", all["points"][std::string(id)]["vertex"]}};
  const std::string file = work.write("tilted.obj", obj);
  const std::string out = work.path("all.json");
  const Outcome proposed =
      run_semblante({"propose", file, "--points", work.write("twenty.json", twenty.dump()), "--out", out});
  ASSERT_EQ(proposed.exit_code, 0) << proposed.err;
  EXPECT_FALSE(json::parse(read_text(out)).contains("to_mpeg4_axes"));
  const Outcome examined = run_semblante({"examine", file, "--points", out});
  EXPECT_NE(examined.err.find("is tilted by 2"), std::string::npos) << examined.err;
  EXPECT_EQ(examined.out.find("not-upright"), std::string::npos) << examined.out;
}

TEST_F(Heads, Weights_HaveARowPerFileVertex_BetweenZeroAndOne) {
  for (const HeadFiles& head : all()) {
    const json weights = weights_of(head);
    const Model model = import_file(head.model);
    ASSERT_EQ(weights["vertices"].size(), model.positions.size()) << head.name;
    std::set<std::string> marked;
    for (const json& id : weights["points"]) marked.insert(id.get<std::string>());
    std::size_t influenced = 0;
    for (const json& row : weights["vertices"]) {
      influenced += row.empty() ? 0 : 1;
      for (const json& entry : row) {
        ASSERT_TRUE(marked.contains(entry[0].get<std::string>())) << head.name;
        ASSERT_GT(entry[1].get<double>(), 0.0) << head.name;
        ASSERT_LE(entry[1].get<double>(), 1.0) << head.name;
      }
    }
    EXPECT_GT(influenced, model.positions.size() / 4) << head.name;
  }
}

TEST_F(Heads, Faces_MoveSomeVertices_AndNoneFarAway) {
  for (const HeadFiles& head : all()) {
    const Model rest = import_file(head.model);
    glm::vec3 low = rest.positions.front();
    glm::vec3 high = low;
    for (const glm::vec3& p : rest.positions) {
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
    const float height = high.y - low.y;
    for (const std::vector<std::string>& face :
         std::vector<std::vector<std::string>>{{"--viseme", "10", "--intensity", "1"},
                                               {"--viseme", "p_b_m"},
                                               {"--expression", "joy"},
                                               {"--expression", "surprise", "--viseme", "o", "--faps", "3=100"}}) {
      const std::string out = work.path("face.obj");
      std::vector<std::string> arguments = {"deform", head.model, "--feature-points", head.points, "--out", out};
      arguments.insert(arguments.end(), face.begin(), face.end());
      const Outcome outcome = run_semblante(arguments);
      ASSERT_EQ(outcome.exit_code, 0) << head.name << ": " << outcome.err;
      const Model moved = import_file(out);
      ASSERT_EQ(moved.positions.size(), rest.positions.size()) << head.name;
      ASSERT_EQ(moved.triangles, rest.triangles) << head.name;
      std::size_t count = 0;
      for (std::size_t v = 0; v < rest.positions.size(); ++v) {
        const float distance = glm::distance(moved.positions[v], rest.positions[v]);
        ASSERT_LT(distance, 0.2F * height) << head.name << " " << face[0] << " " << face[1] << " vertex " << v;
        count += distance > 1e-4F * height ? 1 : 0;
      }
      EXPECT_GT(count, rest.positions.size() / 50) << head.name << " " << face[0] << " " << face[1];
    }
  }
}

TEST_F(Heads, Package_IsWritten_UnderTheNamesClientsFetch) {
  const HeadFiles head = of_our_own("sample");
  const Outcome outcome =
      run_semblante({"parametrize", head.model, "--feature-points", head.points, "--out", work.path("package")});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const char* const name : {"mesh.drc", "weights", "rig.json", "face.glb"}) {
    EXPECT_GT(std::filesystem::file_size(work.path("package/") + name), 1000U) << name;
  }
  const json rig = json::parse(read_text(work.path("package/rig.json")));
  EXPECT_EQ(rig["name"], "sample");
  // Images are kept under their hashes, as rig.json names them.
  for (const json& image : rig["images"]) {
    EXPECT_TRUE(std::filesystem::exists(work.path("package/artefacts/") + image["sha256"].get<std::string>()));
  }
  const Model neutral = import_file(work.path("package/face.glb"));
  EXPECT_EQ(neutral.triangles.size(), import_file(head.model).triangles.size());
}

// Several file vertices may share a position, on one surface or on two that touch: all rows of a place together.
std::map<std::array<float, 3>, std::set<std::string>> rows_by_place(const Model& model, const json& weights) {
  std::map<std::array<float, 3>, std::set<std::string>> rows;
  for (std::size_t v = 0; v < model.positions.size(); ++v) {
    const glm::vec3& p = model.positions[v];
    rows[{p.x + 0.0F, p.y + 0.0F, p.z + 0.0F}].insert(weights["vertices"][v].dump());
  }
  return rows;
}

TEST_F(Heads, Glb_HasTheWeightsOfItsObj_AtTheSamePositions) {
  const SampleHead head = make_sample_head();
  HeadFiles glb = of_our_own("sample");
  // The points by their positions: the OBJ has no seams, and so other numbers.
  json by_place = json::parse(read_text(glb.points));
  for (auto& [id, point] : by_place["points"].items()) point["vertex"] = nullptr;
  glb.points = work.write("places.fps.json", by_place.dump());
  const HeadFiles obj{"sample obj", work.write("sample.obj", testing::obj_of(head)), glb.points};
  // As text, so to the last bit.
  EXPECT_TRUE(rows_by_place(import_file(obj.model), weights_of(obj)) ==
              rows_by_place(import_file(glb.model), weights_of(glb)));
}

TEST_F(Heads, GlbOfMakehuman_HasTheWeightsOfItsObj_AtTheSamePositions) {
  const auto folder = faces_directory() / "makehuman";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no " << folder;
  const std::string points = (folder / "makehuman.fps.json").string();
  const auto rows_of = [&](const char* file) {
    const HeadFiles head{file, (folder / file).string(), points};
    return rows_by_place(import_file(head.model), weights_of(head));
  };
  const auto obj = rows_of("head.obj");
  const auto glb = rows_of("head.glb");
  EXPECT_EQ(obj.size(), glb.size());
  // As text, so to the last bit.
  EXPECT_TRUE(obj == glb);
}

}  // namespace
}  // namespace semblante::test
