// The real program on heads made here: what it writes, and how it refuses.
#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/wait.h>

#include "core/geometry/surface.h"
#include "core/import/feature_points_file.h"
#include "core/import/import.h"
#include "core/parametrize/parametrize.h"
#include "core/parametrize/place_feature_points.h"
#include "tests/integration/cli/program.h"
#include "tests/support/wait.h"

namespace semblante::test {
namespace {

using nlohmann::json;

/// A 9 by 9 sheet at z = 0 with a slight hill, one unit a step: vertex 9 * row + column. One vertex, 81, is used by no
/// face.
std::string sheet_obj() {
  std::ostringstream text;
  for (int row = 0; row < 9; ++row) {
    for (int column = 0; column < 9; ++column) {
      text << "v " << column << " " << row << " " << 0.125 * ((row * 7 + column * 3) % 4) << "\n";
    }
  }
  text << "v 100 0.1 -1e-3\n";
  for (int row = 0; row < 9; ++row) {
    for (int column = 0; column < 9; ++column) text << "vt " << column / 8.0 << " " << row / 8.0 << "\n";
  }
  text << "g sheet\nusemtl paper\n";
  for (int row = 0; row < 8; ++row) {
    for (int column = 0; column < 8; ++column) {
      const int a = 9 * row + column + 1;
      text << "f";
      for (const int v : {a, a + 1, a + 10, a + 9}) text << " " << v << "/" << v;
      text << "\n";
    }
  }
  return text.str();
}

/// 2.1 low in the middle, 8.3 and 8.4 as mouth corners (x 6 and 2), 2.2 and 9.15 above them, 7.1 behind.
constexpr const char* sheet_points = R"({"points": {"9.15": {"vertex": 58}, "2.1": {"vertex": 13},
  "8.3": {"vertex": 33}, "8.4": {"vertex": 29}, "2.2": {"vertex": 40},
  "7.1": {"vertex": null, "position": [4, 4, -3]}}})";

struct Sheet : ::testing::Test {
  Workspace work;
  std::string model = work.write("sheet.obj", sheet_obj());
  std::string points = work.write("fps.json", sheet_points);

  [[nodiscard]] Outcome deform(std::vector<std::string> face) const {
    std::vector<std::string> arguments = {"deform", model, "--feature-points", points, "--out", work.path("out.obj")};
    arguments.insert(arguments.end(), face.begin(), face.end());
    return run_semblante(arguments);
  }
  [[nodiscard]] Model deformed() const { return import_text(read_text(work.path("out.obj"))); }
  static Model import_text(const std::string& text) {
    auto model = import_model({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}, ModelFormat::obj);
    EXPECT_TRUE(model);
    return model ? *model : Model{};
  }
};

TEST_F(Sheet, Fapu_ReplacesTheMeasuredUnitAndHostileOnesAreRefused) {
  const auto parametrize = [&](const std::string& fapu) {
    return run_semblante({"parametrize", model, "--points", points, "--fapu", fapu, "--out", work.path("package")});
  };
  ASSERT_EQ(parametrize("MW=8").exit_code, 0);
  EXPECT_EQ(json::parse(read_text(work.path("package/rig.json")))["fapu"]["MW"].get<double>() * 1024, 8.0);
  for (const char* const bad :
       {"MW=0", "MW=-1", "MW=nan", "MW=inf", "MW=1e300", "MW=8x", "MW=", "MW", "AU=1", "mw=8"}) {
    const Outcome outcome = parametrize(bad);
    EXPECT_NE(outcome.exit_code, 0) << bad;
    EXPECT_NE(outcome.err.find("--fapu: '" + std::string(bad) + "'"), std::string::npos) << outcome.err;
  }
}

TEST_F(Sheet, Propose_WritesAllPointsMarked_AndAgainFromThePlacedOnes) {
  const std::string enough = work.write("enough.json", R"({"points": {"9.3": {"vertex": 58}, "2.1": {"vertex": 13},
    "8.3": {"vertex": 33}, "8.4": {"vertex": 29}, "2.2": {"vertex": 40}, "8.1": {"vertex": 49},
    "3.7": {"vertex": 70}, "3.12": {"vertex": 64}}})");
  const Outcome outcome = run_semblante({"propose", model, "--points", enough, "--out", work.path("all.json")});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const json all = json::parse(read_text(work.path("all.json")));
  EXPECT_EQ(all["points"]["8.1"]["vertex"], 49);
  EXPECT_FALSE(all["points"]["8.1"].contains("proposed"));
  ASSERT_TRUE(all["points"].contains("5.1"));
  EXPECT_EQ(all["points"]["5.1"]["proposed"], true);
  // A sheet without a mouth: all that is near the lower lip's place is as near to the upper lip along the surface.
  EXPECT_EQ(all["not_proposed"]["8.2"], "the surface has no free vertex that fits this point at its expected position");
  EXPECT_EQ(all["not_proposed"]["6.1"], "the model has no tongue");
  // The file can be given again; what was proposed in it is proposed anew.
  const Outcome again = run_semblante({"propose", model, "--points", work.path("all.json")});
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(json::parse(again.out), all);
}

TEST_F(Sheet, Propose_NeedsEightPoints_AndNamesTheMissing) {
  const Outcome outcome = run_semblante({"propose", model, "--points", points});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("at least 8"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("11.4"), std::string::npos) << outcome.err;
}

TEST_F(Sheet, WeightsJson_HasARowPerFileVertex_WithAllDigits) {
  const Outcome outcome =
      run_semblante({"parametrize", model, "--feature-points", points, "--weights-json", work.path("w.json")});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  const json weights = json::parse(read_text(work.path("w.json")));
  EXPECT_EQ(weights["points"], json({"2.1", "2.2", "7.1", "8.3", "8.4", "9.15"}));
  ASSERT_EQ(weights["vertices"].size(), 82U);
  EXPECT_EQ(weights["vertices"][13], json::parse(R"([["2.1", 1]])"));
  EXPECT_EQ(weights["vertices"][81], json::array());

  // The same doubles as in this process: not one digit was lost.
  const Model read = import_text(sheet_obj());
  const Surface surface = build_surface(read);
  const auto file = parse_feature_points(sheet_points);
  const auto placed = place_feature_points(read, surface, file->points, nullptr);
  ASSERT_TRUE(placed);
  const auto rig = parametrize(read, surface, *placed);
  ASSERT_TRUE(rig);
  std::size_t entries = 0;
  for (std::size_t v = 0; v < 82; ++v) {
    const json& row = weights["vertices"][v];
    ASSERT_EQ(row.size(), rig->weights.points_of(v).size()) << v;
    for (std::size_t i = 0; i < row.size(); ++i, ++entries) {
      EXPECT_EQ(row[i][0], to_string(rig->weights.points_of(v)[i]));
      EXPECT_EQ(row[i][1].get<double>(), rig->weights.weights_of(v)[i]);
    }
  }
  EXPECT_GT(entries, 82U);
}

TEST_F(Sheet, PointBetweenVertices_HasAVertexAfterThoseOfTheFile_AndFilesOfPointsKeepItsPosition) {
  // A third of the way into the square of 40, 41, 50 and 49.
  const std::string between = work.write("between.json", R"({"points": {"9.15": {"vertex": 58}, "2.1": {"vertex": 13},
    "8.3": {"vertex": 33}, "8.4": {"vertex": 29}, "2.2": {"position": [4.3, 4.4, 0.1]}, "8.1": {"vertex": 49},
    "3.7": {"vertex": 70}, "3.12": {"vertex": 64}, "9.3": {"vertex": 67}}})");
  const Outcome outcome =
      run_semblante({"parametrize", model, "--feature-points", between, "--weights-json", work.path("w.json")});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const json weights = json::parse(read_text(work.path("w.json")));
  ASSERT_EQ(weights["vertices"].size(), 83U);
  EXPECT_EQ(weights["vertices"][82], json::parse(R"([["2.2", 1]])"));
  EXPECT_EQ(weights["vertices"][13], json::parse(R"([["2.1", 1]])"));

  points = between;
  ASSERT_EQ(deform({"--faps", "4=512"}).exit_code, 0);
  const Model face = deformed();
  const Model neutral = import_text(sheet_obj());
  ASSERT_EQ(face.positions.size(), 83U);
  EXPECT_EQ(face.positions[13], neutral.positions[13]);
  EXPECT_NEAR(face.positions[82].x, 4.3F, 0.01);
  // FAP 4 lowers 2.2 by 512 / 1024 of MNS0, and the corners of its triangle by less.
  EXPECT_LT(face.positions[82].y, 4.0F);
  const float fall = 4.4F - face.positions[82].y;
  for (const std::uint32_t corner : {40U, 50U}) {
    EXPECT_LT(face.positions[corner].y, neutral.positions[corner].y) << corner;
    EXPECT_GT(face.positions[corner].y, neutral.positions[corner].y - fall) << corner;
  }

  const Outcome proposed = run_semblante({"propose", model, "--points", between});
  ASSERT_EQ(proposed.exit_code, 0) << proposed.err;
  const json file = json::parse(proposed.out)["points"];
  EXPECT_TRUE(file["2.2"]["vertex"].is_null());
  EXPECT_NEAR(file["2.2"]["position"][0].get<double>(), 4.3, 0.01);
  for (const auto& [id, point] : file.items()) {
    if (point["vertex"].is_null()) continue;
    EXPECT_LT(point["vertex"].get<int>(), 81) << id;
  }
}

TEST_F(Sheet, WeightsJson_NamesItsMethod_AndWhetherRowsAreShares) {
  const auto weights = [&](std::vector<std::string> options) {
    std::vector<std::string> arguments = {"parametrize", model, "--feature-points", points, "--weights-json", "-"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Outcome outcome = run_semblante(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return json::parse(outcome.out);
  };
  const json paper = weights({});
  EXPECT_EQ(paper["weights"], "paper");
  EXPECT_EQ(paper["metric"], "edge");
  EXPECT_EQ(paper["shares"], false);
  const json smooth = weights({"--weights", "smooth", "--metric", "unfolded"});
  EXPECT_EQ(smooth["weights"], "smooth");
  EXPECT_EQ(smooth["metric"], "unfolded");
  EXPECT_EQ(smooth["shares"], true);
  // What the word means: no row of shares is more than the whole; rows of W are.
  const auto greatest_sum = [](const json& file) {
    double greatest = 0.0;
    for (const json& row : file["vertices"]) {
      double sum = 0.0;
      for (const json& entry : row) sum += entry[1].get<double>();
      greatest = std::max(greatest, sum);
    }
    return greatest;
  };
  EXPECT_LE(greatest_sum(smooth), 1.0 + 1e-9);
  EXPECT_GT(greatest_sum(paper), 1.0 + 1e-9);
}

TEST_F(Sheet, Displacements_MoveVertices_ByTheQuotientOfTheirWeights) {
  const std::string moves = work.write("d.json", R"({"2.1": [0, -1, 0.5], "8.3": [0.25, 0, 0]})");
  ASSERT_EQ(deform({"--displacements", moves}).exit_code, 0);
  ASSERT_EQ(run_semblante({"parametrize", model, "--feature-points", points, "--weights-json", work.path("w.json")})
                .exit_code,
            0);
  const json weights = json::parse(read_text(work.path("w.json")));
  const Model rest = import_text(sheet_obj());
  const Model moved = deformed();
  ASSERT_EQ(moved.positions.size(), 82U);
  EXPECT_EQ(moved.triangles, rest.triangles);
  EXPECT_EQ(moved.uvs, rest.uvs);
  EXPECT_EQ(moved.uv_triangles, rest.uv_triangles);
  EXPECT_EQ(moved.primitives[0].name, "sheet");
  EXPECT_EQ(moved.materials[0].name, "paper");
  for (std::size_t v = 0; v < 82; ++v) {
    glm::dvec3 sum(0.0);
    double total = 0.0;
    for (const json& entry : weights["vertices"][v]) {
      const double w = entry[1];
      total += w;
      if (entry[0] == "2.1") sum += w * glm::dvec3(0, -1, 0.5);
      if (entry[0] == "8.3") sum += w * glm::dvec3(0.25, 0, 0);
    }
    const glm::dvec3 expected = glm::dvec3(rest.positions[v]) + (total > 0.0 ? sum / total : glm::dvec3(0.0));
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(moved.positions[v][axis], expected[axis], 1e-6) << v;
  }
}

TEST_F(Sheet, Fap_MovesItsPoint_ByItsUnit) {
  // FAP 3 moves 2.1 down by value * MNS: MNS0 = 9.15.y - 2.2.y = 6 - 4 = 2, so 512 / 1024 * 2 = 1 down.
  ASSERT_EQ(deform({"--faps", "3=512"}).exit_code, 0);
  const Model rest = import_text(sheet_obj());
  const Model moved = deformed();
  EXPECT_NEAR(moved.positions[13].y, rest.positions[13].y - 1.0F, 1e-6F);
  EXPECT_EQ(moved.positions[13].x, rest.positions[13].x);
  EXPECT_EQ(moved.positions[81], rest.positions[81]);
}

TEST_F(Sheet, NeutralFap_LeavesEveryBit_OfEveryPosition) {
  ASSERT_EQ(deform({"--faps", "3=0"}).exit_code, 0);
  EXPECT_EQ(deformed().positions, import_text(sheet_obj()).positions);
}

TEST_F(Sheet, Output_OnStandardOutput_IsTheSameAsInAFile) {
  ASSERT_EQ(deform({"--faps", "3=100"}).exit_code, 0);
  const Outcome outcome = run_semblante({"deform", model, "--feature-points", points, "--faps", "3=100", "--out", "-"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.out, read_text(work.path("out.obj")));
}

TEST_F(Sheet, Options_ComeFromTheEnvironmentToo) {
  const Outcome outcome = run_semblante({"deform"}, {{"SEMBLANTE_MODEL", model},
                                                     {"SEMBLANTE_FEATURE_POINTS", points},
                                                     {"SEMBLANTE_FAPS", "3=512"},
                                                     {"SEMBLANTE_OUT", work.path("env.obj")}});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(read_text(work.path("env.obj")), "");
}

TEST_F(Sheet, OtherAxes_GiveTheSameWeights_AndFacesInTheFilesOwnAxes) {
  // The same sheet in a Z-up file: file (x, y, z) = MPEG-4 (x, -z, y), so MPEG-4 = (x, z, -y).
  std::istringstream lines(sheet_obj());
  std::ostringstream turned;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string keyword;
    double x = 0;
    double y = 0;
    double z = 0;
    if (words >> keyword >> x >> y >> z && keyword == "v") {
      turned << "v " << x << " " << -z << " " << y << "\n";
    } else {
      turned << line << "\n";
    }
  }
  json file = json::parse(sheet_points);
  file["to_mpeg4_axes"] = json::parse("[[1, 0, 0], [0, 0, 1], [0, -1, 0]]");
  file["points"]["7.1"]["position"] = {4, 3, 4};
  const std::string other_model = work.write("turned.obj", turned.str());
  const std::string other_points = work.write("turned.json", file.dump());
  const auto weights = [](const std::string& head, const std::string& fps) {
    const Outcome outcome = run_semblante({"parametrize", head, "--feature-points", fps, "--weights-json", "-"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return outcome.out;
  };
  EXPECT_EQ(weights(other_model, other_points), weights(model, points));

  ASSERT_EQ(deform({"--faps", "3=512"}).exit_code, 0);
  const Model straight = deformed();
  ASSERT_EQ(run_semblante({"deform", other_model, "--feature-points", other_points, "--faps", "3=512", "--out",
                           work.path("out.obj")})
                .exit_code,
            0);
  const Model back = deformed();
  EXPECT_EQ(back.triangles, straight.triangles);
  for (std::size_t v = 0; v < 82; ++v) {
    EXPECT_NEAR(back.positions[v].x, straight.positions[v].x, 1e-6F);
    EXPECT_NEAR(back.positions[v].y, -straight.positions[v].z, 1e-6F);
    EXPECT_NEAR(back.positions[v].z, straight.positions[v].y, 1e-6F);
  }
}

/// One line on stderr that names what is wrong, exit code 2, and nothing written.
TEST_F(Sheet, BadInput_IsRefused_InOneLineThatNamesIt) {
  struct Case {
    const char* name;
    std::vector<std::string> arguments;
    std::vector<std::string> says;
  };
  const std::string out = work.path("out.obj");
  const auto fps = [this](const std::string& json) {
    static int number = 0;
    return work.write(std::to_string(++number) + ".json", json);
  };
  const auto with_points = [&](const std::string& path) {
    return std::vector<std::string>{"deform", model, "--feature-points", path, "--faps", "3=1", "--out", out};
  };
  const auto with_model = [&](const std::string& path) {
    return std::vector<std::string>{"deform", path, "--feature-points", points, "--faps", "3=1", "--out", out};
  };
  const auto with_face = [&](std::vector<std::string> face) {
    std::vector<std::string> arguments = {"deform", model, "--feature-points", points, "--out", out};
    arguments.insert(arguments.end(), face.begin(), face.end());
    return arguments;
  };
  const std::vector<Case> cases = {
      {"no subcommand", {}, {"subcommand"}},
      {"unknown subcommand",
       {"dance"},
       {"parametrize, deform", "extract, play, propose, say, serve, doctor, token, check, backup or restore",
        "--help"}},
      {"a port that is none", {"serve", "--port", "70000"}, {"--port", "65535"}},
      {"fewer than no models", {"serve", "--max-models", "-1"}, {"--max-models"}},
      {"fewer than no bytes", {"serve", "--max-upload-bytes=-1"}, {"--max-upload-bytes"}},
      {"unknown option", with_face({"--dance"}), {"--dance"}},
      {"parametrize to nowhere", {"parametrize", model, "--feature-points", points}, {"--weights-json", "--out"}},
      {"no feature points", {"parametrize", model, "--out", out}, {"--feature-points"}},
      {"no face", with_face({}), {"--faps", "--viseme", "--expression", "--displacements"}},
      {"model not there", with_model(work.path("none.obj")), {"none.obj", "No such file"}},
      {"model is a folder", with_model(work.path("")), {"folder"}},
      {"model is empty", with_model(work.write("empty.obj", "")), {"empty.obj", "empty"}},
      {"model is prose", with_model(work.write("prose.obj", "once upon a time\n")), {"prose.obj", "line 1"}},
      {"model is nothing known", with_model(work.write("prose.txt", "once upon")), {"prose.txt", "GLB"}},
      {"model has NaN", with_model(work.write("nan.obj", "v 0 0 nan\n")), {"nan.obj", "line 1", "nan"}},
      {"model is cut short", with_model(work.write("cut.glb", "glTF\2")), {"cut.glb", "12 bytes"}},
      {"format says otherwise",
       {"deform", model, "--feature-points", points, "--format", "stl", "--faps", "3=1", "--out", out},
       {"sheet.obj"}},
      {"unknown format", with_face({"--faps", "3=1", "--format", "fbx"}), {"--format", "fbx"}},
      {"points not there", with_points(work.path("none.json")), {"none.json", "No such file"}},
      {"points are no JSON", with_points(fps("hello")), {"not valid JSON"}},
      {"unknown point", with_points(fps(R"({"points": {"2.15": {"vertex": 1}}})")), {"/points/2.15"}},
      {"vertex is text",
       with_points(fps(R"({"points": {"2.1": {"vertex": "1"}}})")),
       {"/points/2.1/vertex", "whole number"}},
      {"vertex negative", with_points(fps(R"({"points": {"2.1": {"vertex": -1}}})")), {"/points/2.1/vertex"}},
      {"vertex not there", with_points(fps(R"({"points": {"2.1": {"vertex": 82}}})")), {"/points/2.1", "82"}},
      {"position far away", with_points(fps(R"({"points": {"2.1": {"position": [9999, 0, 0]}}})")), {"/points/2.1"}},
      {"FAP 99", with_face({"--faps", "99=1"}), {"--faps", "99"}},
      {"FAP 0", with_face({"--faps", "0=1"}), {"--faps", "no FAP 0"}},
      {"FAP 1", with_face({"--faps", "1=1"}), {"--faps", "--viseme"}},
      {"FAP is text", with_face({"--faps", "jaw=1"}), {"--faps", "jaw=1"}},
      {"FAP value is text", with_face({"--faps", "3=open"}), {"--faps", "3=open"}},
      {"FAP value is NaN", with_face({"--faps", "3=nan"}), {"--faps", "3=nan"}},
      {"FAP without value", with_face({"--faps", "3"}), {"--faps", "<number>=<value>"}},
      {"FAP twice", with_face({"--faps", "3=1,3=2"}), {"--faps", "twice"}},
      {"FAP trailing comma", with_face({"--faps", "3=1,"}), {"--faps"}},
      {"FAP of a point not marked", with_face({"--faps", "4=1,51=1"}), {"51", "8.1", "not marked"}},
      {"FAP of a unit not known", with_face({"--faps", "31=1"}), {"31", "ENS"}},
      {"viseme 15", with_face({"--viseme", "15"}), {"--viseme", "15", "0 to 14"}},
      {"viseme unknown", with_face({"--viseme", "xyz"}), {"--viseme", "xyz", "p_b_m"}},
      {"expression 7", with_face({"--expression", "7"}), {"--expression", "1 to 6"}},
      {"expression unknown", with_face({"--expression", "boredom"}), {"--expression", "boredom", "joy"}},
      {"intensity 2", with_face({"--viseme", "10", "--intensity", "2"}), {"--intensity"}},
      {"intensity text", with_face({"--viseme", "10", "--intensity", "much"}), {"--intensity"}},
      {"displacements not there", with_face({"--displacements", work.path("none")}), {"none", "No such file"}},
      {"displacements of unknown point", with_face({"--displacements", fps(R"({"1.1": [0, 0, 0]})")}), {"/1.1"}},
      {"displacement of unmarked point",
       with_face({"--displacements", fps(R"({"3.1": [0, 0, 0]})")}),
       {"/3.1", "not marked"}},
      {"displacement of bare position",
       with_face({"--displacements", fps(R"({"7.1": [0, 0, 0]})")}),
       {"/7.1", "moves no vertex"}},
      {"displacement of two numbers", with_face({"--displacements", fps(R"({"2.1": [0, 0]})")}), {"/2.1"}},
      {"displacement of text", with_face({"--displacements", fps(R"({"2.1": [0, "x", 0]})")}), {"/2.1/1"}},
      {"displacements with FAPs",
       with_face({"--displacements", fps(R"({"2.1": [0, 0, 1]})"), "--faps", "3=1"}),
       {"--displacements", "--faps"}},
      {"out is in no folder",
       {"deform", model, "--feature-points", points, "--faps", "3=1", "--out", work.path("none/out.obj")},
       {"none/out.obj"}},
      {"weight bits",
       {"parametrize", model, "--feature-points", points, "--out", work.path("p"), "--weight-bits", "4"},
       {"--weight-bits"}},
  };
  for (const Case& test : cases) {
    const Outcome outcome = run_semblante(test.arguments);
    EXPECT_EQ(outcome.exit_code, 2) << test.name << ": " << outcome.err;
    EXPECT_EQ(outcome.out, "") << test.name;
    EXPECT_EQ(line_count(outcome.err), 1U) << test.name << ": " << outcome.err;
    for (const std::string& what : test.says) {
      EXPECT_NE(outcome.err.find(what), std::string::npos) << test.name << ": no '" << what << "' in " << outcome.err;
    }
    EXPECT_FALSE(std::filesystem::exists(out)) << test.name;
  }
}

TEST_F(Sheet, Examine_SaysWhatIsWrong_AndItsExitStatusWhetherItIsAnError) {
  const Outcome words = run_semblante({"examine", model});
  EXPECT_EQ(words.exit_code, 0) << words.err;
  EXPECT_NE(words.out.find("note unused-vertices: 1 vertex belongs to no triangle"), std::string::npos) << words.out;
  EXPECT_NE(words.out.find("where: vertex 81"), std::string::npos) << words.out;
  EXPECT_NE(words.out.find("remedy: "), std::string::npos) << words.out;

  const Outcome data = run_semblante({"examine", model, "--points", points, "--json"});
  const json report = json::parse(data.out);
  EXPECT_EQ(report["version"], 1);
  EXPECT_EQ(data.exit_code, report["summary"]["errors"] == 0 ? 0 : 1) << data.err;
}

TEST_F(Sheet, Examine_TellsEveryPointItCannotPlace_AndGoesOn) {
  const std::string wrong = work.write("wrong.json", R"({"points": {"2.1": {"vertex": 999}, "2.2": {"vertex": 40},
    "8.3": {"vertex": 29}, "8.4": {"vertex": 33}, "3.5": {"position": [1e9, 0, 0]}}})");
  const Outcome outcome = run_semblante({"examine", model, "--points", wrong});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(line_count(outcome.err), 2U) << outcome.err;
  EXPECT_NE(outcome.err.find("the axes of the head are uncertain"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("errors"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.out.find("error point-refused: point 2.1 is at vertex 999"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("error missing-points: "), std::string::npos) << outcome.out;
}

TEST(Cli, Help_NamesTheEnvironment_OfEveryOption) {
  for (const char* const command : {"parametrize", "deform", "examine", "propose"}) {
    const Outcome outcome = run_semblante({command, "--help"});
    EXPECT_EQ(outcome.exit_code, 0);
    std::istringstream lines(outcome.out);
    std::size_t options = 0;
    for (std::string line; std::getline(lines, line);) {
      if (line.find("  --") != 0) continue;
      ++options;
      EXPECT_NE(line.find("(Env:SEMBLANTE_"), std::string::npos) << line;
    }
    EXPECT_GT(options, 3U);
  }
}

/// Runs the program with these arguments and redirections of a shell; its exit code.
int run_in_shell(const std::string& arguments) {
  const int status = std::system(("\"" SEMBLANTE_BINARY_DIR "/bin/semblante\" " + arguments).c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(Cli, OutputThatIsLost_IsNoSuccess) {
  const Workspace workspace;
  const auto said = workspace.path("said");
  EXPECT_EQ(run_in_shell("version > /dev/full 2> " + said), 1);
  EXPECT_EQ(read_text(said), "semblante: standard output cannot be written\n");
  EXPECT_EQ(run_in_shell("serve --help > /dev/full 2> /dev/null"), 1);
  EXPECT_EQ(run_in_shell("version > /dev/null"), 0);
  EXPECT_EQ(run_in_shell("version >&-"), 0) << "somebody does not want it";
}

TEST(Cli, ClosedStreams_AreTakenByNoFile) {
  const Workspace workspace;
  const auto data = workspace.path("data"), running = workspace.path("pid");
  ASSERT_EQ(std::system(("\"" SEMBLANTE_BINARY_DIR "/bin/semblante\" serve --port 0 --data " + data +
                         " <&- >&- 2>&- & echo $! > " + running)
                            .c_str()),
            0);
  const pid_t pid = std::stoi(read_text(running));
  EXPECT_TRUE(testing::eventually([&] { return std::filesystem::exists(data + "/last-database"); }));
  for (const auto* number : {"0", "1", "2"}) {
    std::error_code error;
    const auto file = std::filesystem::read_symlink("/proc/" + std::to_string(pid) + "/fd/" + number, error);
    EXPECT_EQ(file, "/dev/null") << number << error.message();
  }
  ::kill(pid, SIGTERM);
  EXPECT_TRUE(testing::eventually([&] {
    std::error_code ignored;  // false of a zombie too, where nobody waits for orphans
    return !std::filesystem::exists("/proc/" + std::to_string(pid) + "/exe", ignored);
  }));
}

}  // namespace
}  // namespace semblante::test
