// `semblante convert --out FILE.glb`: an animated face for other people's viewers.
#include <fstream>

#include <gtest/gtest.h>

#include "core/import/import.h"
#include "deploy/sample_head/write_sample_head.h"
#include "tests/integration/cli/program.h"

namespace semblante::test {
namespace {

constexpr const char* nod = R"({"format":"semblante.performance","version":1,"duration":400,
  "cues":[{"time":0,"fap":"open_jaw","keys":[[0,0],[200,400],[400,0]],"easing":"linear"},
          {"time":0,"fap":"head_pitch","keys":[[0,0],[200,9000],[400,0]],"easing":"linear"}]})";

struct ConvertToClip : ::testing::Test {
  Workspace work;
  std::string performance = work.write("nod.json", nod);
  std::string head = work.path("head.glb");
  std::string points;

  void SetUp() override {
    const SampleHead sample = make_sample_head();
    const auto made = sample_head_glb(sample);
    ASSERT_TRUE(made);
    const auto& glb = *made;
    std::ofstream(head, std::ios::binary)
        .write(reinterpret_cast<const char*>(glb.data()), static_cast<std::streamsize>(glb.size()));
    points = work.write("head.fps.json", sample_head_feature_points_json(sample));
  }

  [[nodiscard]] Outcome convert(const std::string& out, std::vector<std::string> more) const {
    std::vector<std::string> arguments = {"convert", performance, "--out", work.path(out)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_semblante(arguments);
  }
};

TEST_F(ConvertToClip, OfAHeadOrOfItsPackage_IsOneFile) {
  const Outcome of_head = convert("head-nod.glb", {"--model", head, "--points", points, "--weights", "smooth"});
  ASSERT_EQ(of_head.exit_code, 0) << of_head.err;
  const std::string glb = read_text(work.path("head-nod.glb"));
  for (const char* word : {"\"animations\"", "\"name\":\"nod\"", "\"JOINTS_1\"", "\"fp_2.1\"", "\"quantum\""})
    EXPECT_NE(glb.find(word), std::string::npos) << word;

  ASSERT_EQ(run_semblante({"parametrize", head, "--points", points, "--weights", "smooth", "--lods", "3000", "--out",
                           work.path("package")})
                .exit_code,
            0);
  ASSERT_EQ(convert("package-nod.glb", {"--package", work.path("package")}).exit_code, 0);
  EXPECT_EQ(read_text(work.path("package-nod.glb")), glb);
  const Outcome of_level = convert("level-nod.glb", {"--package", work.path("package") + "/lod1", "--influences", "4"});
  ASSERT_EQ(of_level.exit_code, 0) << of_level.err;
  const std::string level = read_text(work.path("level-nod.glb"));
  EXPECT_LT(level.size(), glb.size());
  EXPECT_EQ(level.find("\"JOINTS_1\""), std::string::npos);

  // Our own import reads it: the neutral face.
  const auto model = import_model({reinterpret_cast<const std::uint8_t*>(glb.data()), glb.size()}, ModelFormat::glb);
  ASSERT_TRUE(model) << model.error().message;
  const auto before = read_text(head);
  const auto original =
      import_model({reinterpret_cast<const std::uint8_t*>(before.data()), before.size()}, ModelFormat::glb);
  EXPECT_EQ(model->triangles.size(), original->triangles.size());
  EXPECT_EQ(model->images.size(), original->images.size());
}

TEST_F(ConvertToClip, OfAHeadWithoutPoints_TakesThoseOfItsShape) {
  const Outcome outcome = convert("found.glb", {"--model", head, "--weights", "smooth"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("feature points are found by the shape of the face"), std::string::npos) << outcome.err;
  // The same as with the file that `propose` writes.
  ASSERT_EQ(run_semblante({"propose", head, "--out", work.path("found.fps.json")}).exit_code, 0);
  ASSERT_EQ(
      convert("given.glb", {"--model", head, "--weights", "smooth", "--points", work.path("found.fps.json")}).exit_code,
      0);
  EXPECT_EQ(read_text(work.path("found.glb")), read_text(work.path("given.glb")));
}

TEST_F(ConvertToClip, WithoutAFace_OrWithTwo_IsRefused) {
  Outcome outcome = convert("x.glb", {});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("a clip needs a face"), std::string::npos) << outcome.err;
  EXPECT_EQ(convert("x.glb", {"--model", head, "--points", points, "--package", work.path("p")}).exit_code, 2);
  EXPECT_EQ(convert("x.glb", {"--model", head, "--points", points, "--influences", "5"}).exit_code, 2);
  outcome = convert("x.glb", {"--package", work.path("nowhere")});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("mesh.drc"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace semblante::test
