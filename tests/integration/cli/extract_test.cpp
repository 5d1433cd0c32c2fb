// `semblante extract` and `deform --set` on sheets made here, whose numbers can be told by hand.
#include <cstdlib>
#include <filesystem>
#include <sstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/import/import.h"
#include "deploy/sample_head/write_sample_head.h"
#include "tests/integration/cli/program.h"
#include "tests/support/sample_shapes.h"

namespace semblante::test {
namespace {

using nlohmann::json;

/// A 9 by 9 sheet of steps of `scale`, vertex 9 * row + column; `moved` alone is elsewhere. Without faces on request.
std::string sheet(double scale, bool has_faces = true, int moved = -1, const std::string& to = "") {
  std::ostringstream text;
  for (int v = 0; v < 81; ++v) {
    if (v == moved)
      text << "v " << to << "\n";
    else
      text << "v " << scale * (v % 9) << " " << scale * (v / 9) << " " << scale * 0.125 * ((v / 9 * 7 + v % 9 * 3) % 4)
           << "\n";
  }
  for (int a = 1; has_faces && a <= 71; ++a) {
    if (a % 9 != 0) text << "f " << a << " " << a + 1 << " " << a + 10 << " " << a + 9 << "\n";
  }
  return text.str();
}

/// MW0 is 4 steps (8.3 to 8.4), MNS0 2 (9.15 to 2.2).
constexpr const char* framed_sheet_points = R"({"to_mpeg4_axes": [[1, 0, 0], [0, 1, 0], [0, 0, 1]],
  "points": {"9.15": {"vertex": 58}, "2.1": {"vertex": 13}, "8.3": {"vertex": 33}, "8.4": {"vertex": 29},
  "2.2": {"vertex": 40}, "7.1": {"vertex": null, "position": [4, 4, -3]}}})";

struct Extract : ::testing::Test {
  Workspace work;
  std::string neutral = work.write("neutral.obj", sheet(1.0));
  // Vertex 33 from (6, 3, 0.125 * ((21 + 18) % 4)) = (6, 3, 0.375) to the side by 1 and down by a half.
  std::string smile = work.write("smile.obj", sheet(1.0, false, 33, "7 2.5 0.375"));
  std::string points = work.write("fps.json", framed_sheet_points);

  [[nodiscard]] Outcome extract(std::vector<std::string> more) const {
    std::vector<std::string> arguments = {"extract", neutral, "--points", points, "--out", work.path("set.json")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_semblante(arguments);
  }
  [[nodiscard]] json set() const { return json::parse(read_text(work.path("set.json"))); }
};

TEST_F(Extract, WritesTheDifferenceInUnits_AndSaysWhatIsMissing) {
  const Outcome outcome = extract({smile});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  // 1 / (4 / 1024), -0.5 / (2 / 1024)
  EXPECT_EQ(set(), json::parse(R"({"name": "smile", "kind": "expression", "displacements": {"8.3": [256, -256, 0]}})"));
  EXPECT_NE(outcome.err.find("they have no vertex: 7.1"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("not marked on this head: "), std::string::npos) << outcome.err;
}

TEST_F(Extract, PointBetweenVertices_MovesAsItsPlaceInTheTriangle) {
  // Three quarters of the way along the edge from 32, which stays, to 33, which moves by (1, -0.5).
  const std::string places = R"("8.3": {"position": [5.75, 3, 0.28125]})";
  std::string text = framed_sheet_points;
  text.replace(text.find(R"("8.3": {"vertex": 33})"), 21, places);
  points = work.write("between.json", text);
  ASSERT_EQ(extract({smile}).exit_code, 0);
  // MW0 is 3.75 steps now.
  const json moved = set()["displacements"]["8.3"];
  EXPECT_NEAR(moved[0].get<double>(), 0.75 / (3.75 / 1024), 0.1);
  EXPECT_NEAR(moved[1].get<double>(), -0.375 / (2.0 / 1024), 0.1);
}

TEST_F(Extract, ASetIsWornByAnotherSheet_AsFarAsAsked) {
  ASSERT_EQ(extract({smile, "--kind", "viseme", "--name", "Grin", "--strength", "0.5"}).exit_code, 0);
  EXPECT_EQ(set()["displacements"]["8.3"], json::parse("[512, -512, 0]"));
  const std::string other = work.write("other.obj", sheet(10.0));
  const Outcome outcome = run_semblante({"deform", other, "--points", points, "--set", work.path("set.json"), "--at",
                                         "0.25", "--out", work.path("worn.obj")});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const std::string text = read_text(work.path("worn.obj"));
  const auto worn = import_model({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}, ModelFormat::obj);
  ASSERT_TRUE(worn);
  // A quarter of 512 units of 40 / 1024 and 20 / 1024, from (60, 30, 3.75).
  EXPECT_NEAR(worn->positions[33].x, 65.0F, 1e-4);
  EXPECT_NEAR(worn->positions[33].y, 27.5F, 1e-4);
  EXPECT_NEAR(worn->positions[33].z, 3.75F, 1e-4);
}

TEST_F(Extract, RefusesInOneLine_NamingWhatIsWrong) {
  const auto refused = [](const Outcome& outcome, const std::string& words) {
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_NE(outcome.err.find(words), std::string::npos) << outcome.err;
    EXPECT_EQ(line_count(outcome.err), 1U) << outcome.err;
  };
  refused(extract({}), "give the file of the expression, or --target");
  refused(extract({"--target", "smile"}),
          "--target smile: the model has no morph target of this name; it has no morph targets");
  refused(extract({neutral}), "moves none of the marked feature points");
  refused(extract({work.write("fewer.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")}),
          "has 3 vertices, the neutral head 81");
  refused(extract({work.write("nan.obj", sheet(1.0, false, 33, "7 nan 0"))}), "line 34");
  refused(extract({work.write("huge.obj", sheet(1.0, false, 33, "1e9 0 0"))}), "8.3 moves by more than 100 MW0");
  refused(extract({smile, "--least", "-1"}), "--least");
  refused(extract({smile, "--strength", "0"}), "--strength");
  refused(extract({work.path("nowhere.obj")}), "nowhere.obj");
  EXPECT_FALSE(std::filesystem::exists(work.path("set.json")));

  const auto deform = [&](const std::string& set, std::vector<std::string> more = {}) {
    std::vector<std::string> arguments = {
        "deform", neutral, "--points", points, "--set", work.write("bad.json", set), "--out", work.path("worn.obj")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_semblante(arguments);
  };
  refused(deform(R"({"displacements": {"8.3": [1, 2]}})"), "/displacements/8.3");
  refused(deform(R"({"displacements": {"8.3": [1, 2, 3]}})", {"--expression", "joy"}), "give one of them");
}

TEST_F(Extract, ReadsMorphTargetsOfAnAvatar) {
  const auto& bytes = testing::sample_avatar_glb();
  const std::string model = work.write("avatar.glb", std::string(bytes.begin(), bytes.end()));
  const std::string marked = work.write("avatar.fps.json", sample_head_feature_points_json(testing::sample_avatar()));
  const auto take = [&](const std::string& target, const std::string& from) {
    std::vector<std::string> arguments = {"extract",  model,  "--points", marked,
                                          "--target", target, "--out",    work.path("set.json")};
    if (!from.empty()) arguments.insert(arguments.end(), {"--from", from});
    return run_semblante(arguments);
  };
  const Outcome blink = take("eyeBlinkLeft", "");
  ASSERT_EQ(blink.exit_code, 0) << blink.err;
  const json closing = set();
  EXPECT_EQ(closing["name"], "eyeBlinkLeft");
  EXPECT_LT(closing["displacements"]["3.1"][1], -300);
  EXPECT_FALSE(closing["displacements"].contains("3.2"));
  // From closed on the right to closed on the left: both lids move, against each other.
  ASSERT_EQ(take("eyeBlinkLeft", "eyeBlinkRight").exit_code, 0);
  EXPECT_LT(set()["displacements"]["3.1"][1], -300);
  EXPECT_GT(set()["displacements"]["3.2"][1], 300);
  const Outcome unknown = take("grin", "");
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_NE(unknown.err.find("viseme_aa"), std::string::npos) << unknown.err;
}

TEST_F(Extract, ReadsMorphTargetsOfAGlb) {
  const char* const set_folder = std::getenv("SEMBLANTE_FACES_DIR");
  const auto folder =
      std::filesystem::path(set_folder != nullptr
                                ? set_folder
                                : std::filesystem::path(SEMBLANTE_SOURCE_DIR).parent_path() / "shared/faces") /
      "makehuman";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no " << folder;
  const auto take = [&](const std::string& target, const std::string& from) {
    std::vector<std::string> arguments = {"extract",  (folder / "head.glb").string(),
                                          "--points", (folder / "makehuman.fps.json").string(),
                                          "--target", target,
                                          "--out",    work.path("set.json")};
    if (!from.empty()) arguments.insert(arguments.end(), {"--from", from});
    return run_semblante(arguments);
  };
  ASSERT_EQ(take("eyeClosedLeft", "").exit_code, 0);
  const json closing = set();
  EXPECT_EQ(closing["name"], "eyeClosedLeft");
  EXPECT_LT(closing["displacements"]["3.1"][1], -300);
  EXPECT_FALSE(closing["displacements"].contains("3.2"));
  // From closed on the right to closed on the left: both lids move, against each other.
  ASSERT_EQ(take("eyeClosedLeft", "eyeClosedRight").exit_code, 0);
  EXPECT_LT(set()["displacements"]["3.1"][1], -300);
  EXPECT_GT(set()["displacements"]["3.2"][1], 300);
  const Outcome unknown = take("grin", "");
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_NE(unknown.err.find("it has "), std::string::npos);
  EXPECT_NE(unknown.err.find("eyeClosedLeft"), std::string::npos);
}

}  // namespace
}  // namespace semblante::test
