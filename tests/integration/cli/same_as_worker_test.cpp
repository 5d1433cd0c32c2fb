// The command line and a worker of the server take a head through the same pipeline: same files, same warnings.
#include <cstdlib>
#include <filesystem>
#include <iomanip>
#include <sstream>

#include <glm/mat3x3.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/integration/cli/program.h"
#include "tests/support/sample_head_model.h"

namespace semblante::test {
namespace {

using nlohmann::json;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// MPEG-4 (x, y, z) as a file has it.
using Stance = glm::dvec3 (*)(const glm::dvec3&);
/// The head stands along +Z and faces -Y.
glm::dvec3 along_z(const glm::dvec3& p) { return {p.x, -p.z, p.y}; }
/// The head stands along -Z and faces +Y, flatter than any face.
glm::dvec3 flat_along_minus_z(const glm::dvec3& p) { return {p.x, 0.6 * p.z, -p.y}; }

/// The sample head as OBJ, only its front if `is_mask`.
std::string head_obj(Stance stance, bool is_mask) {
  const Model model = testing::sample_head_model();
  std::ostringstream text;
  text << std::setprecision(9);
  for (const glm::vec3& position : model.positions) {
    const glm::dvec3 p = stance(position);
    text << "v " << p.x << " " << p.y << " " << p.z << " 0 0 0\n";  // black, for a warning of the import
  }
  for (const Triangle& t : model.triangles) {
    const bool is_front = model.positions[t[0]].z > 0.02F;
    if (!is_mask || is_front) text << "f " << t[0] + 1 << " " << t[1] + 1 << " " << t[2] + 1 << "\n";
  }
  return text.str();
}

/// The points in front of the ears, by vertex; by vertex and position the first few, as both kinds are turned apart.
json head_points(Stance stance) {
  json points = json::object();
  for (const FeaturePoint& point : testing::sample_head_points()) {
    if (point.position.z < 0.05F || !point.vertex) continue;
    auto& item = points[to_string(point.id)];
    item["vertex"] = point.vertex->value();
    const glm::dvec3 p = stance(point.position);
    if (points.size() < 10) item["position"] = {p.x, p.y, p.z};
  }
  return points;
}

std::string torn_sheet_obj() {
  std::ostringstream text;
  for (int i = 0; i < 81; ++i) text << "v " << i % 9 << " " << i / 9 << " " << 0.125 * (i * 3 % 4) << "\n";
  for (int i = 0; i < 71; ++i) {
    if (i % 9 < 8) text << "f " << i + 1 << " " << i + 2 << " " << i + 11 << " " << i + 10 << "\n";
  }
  return text.str();
}

glm::dvec3 direction(const std::string& name) {
  glm::dvec3 vector(0.0);
  vector[name[1] - 'X'] = name[0] == '+' ? 1.0 : -1.0;
  return vector;
}

struct SameAsWorker : ::testing::Test {
  Workspace work;

  /// Runs one job as the server would; its outcome.
  [[nodiscard]] json run_worker(const char* kind, const json& asked, const std::string& folder) const {
    std::filesystem::create_directories(work.path(folder));
    const json request = {{"kind", kind}, {"output_directory", work.path(folder)}, {"request", asked}};
    const std::string input = work.write(folder + ".json", request.dump());
    const Outcome outcome = run_semblante({"worker"}, {}, input);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
    std::istringstream lines(outcome.out);
    json last;
    for (std::string line; std::getline(lines, line);) last = json::parse(line);
    return last.contains("done") ? last["done"].value("outcome", json::object()) : json::object();
  }

  /// The warnings both gave, of import and of the package.
  struct Warnings {
    std::vector<std::string> import, package;
  };

  /// Takes a head both ways and expects the same. `points` in the axes of the file.
  [[nodiscard]] Warnings compare(const std::string& obj, const json& points) const {
    const std::string model = work.write("head.obj", obj);
    const std::string file = work.write("fps.json", json{{"points", points}}.dump());
    const Outcome command = run_semblante({"parametrize", model, "--points", file, "--out", work.path("cli"), "--name",
                                           "head", "--weights", "smooth", "--lods", "1500"});
    EXPECT_EQ(command.exit_code, 0) << command.err;

    json source = {{"path", model}, {"file_name", "head.obj"}, {"frame_wish", json::object()}};
    const json imported = run_worker("import", {{"model", source}}, "import");
    source["frame"] = imported["frame"];
    json marked = {{"model", source}, {"points", json::array()}, {"parts", imported["parts"]}};
    // The store keeps positions as the import made the head stand.
    const glm::dvec3 up = direction(imported["frame"]["axes"]["up"]);
    const glm::dvec3 front = direction(imported["frame"]["axes"]["front"]);
    const glm::dmat3 turn = glm::transpose(glm::dmat3(glm::cross(up, front), up, front));
    for (const auto& [id, point] : points.items()) {
      json record = point;
      record["id"] = id;
      if (point.contains("position")) {
        const glm::dvec3 p = turn * glm::dvec3(point["position"][0], point["position"][1], point["position"][2]);
        record["position"] = {p.x, p.y, p.z};
      }
      marked["points"].push_back(record);
    }
    const json options = {{"metric", "edge"}, {"weights", "smooth"}, {"weight_bits", 12}, {"lods", {1500}}};
    const json made = run_worker(
        "parametrize", {{"name", "head"}, {"head", marked}, {"options", options}, {"worn", json::object()}}, "made");

    for (const char* const name : {"mesh.drc", "weights", "rig.json", "face.glb"}) {
      EXPECT_EQ(read_text(work.path("cli") + "/" + name), read_text(work.path("made") + "/" + name)) << name;
      EXPECT_EQ(read_text(work.path("cli") + "/lod1/" + name), read_text(work.path("made") + "/lod1." + name)) << name;
    }
    const Warnings warnings{imported["warnings"], made["warnings"]};
    std::string lines;
    for (const std::string& warning : warnings.package) lines += "semblante: warning: " + warning + "\n";
    // The command line adds its advice at the end.
    EXPECT_TRUE(command.err.starts_with(lines)) << command.err << "\n" << lines;
    const json rig = json::parse(read_text(work.path("made") + "/rig.json"));
    EXPECT_EQ(rig["warnings"].get<std::vector<std::string>>(), warnings.package);
    return warnings;
  }
};

TEST_F(SameAsWorker, BodyAlongZ) {
  const Warnings warnings = compare(head_obj(along_z, false), head_points(along_z));
  ASSERT_GE(warnings.package.size(), 2U);
  EXPECT_THAT(warnings.import, ElementsAre(HasSubstr("vertex colours"), HasSubstr("the head stands along +Z")));
  // Once each, though the model was read twice.
  EXPECT_THAT(warnings.package[0], HasSubstr("vertex colours"));
  EXPECT_THAT(warnings.package[1], HasSubstr("the head stands along +Z"));
  EXPECT_THAT(warnings.package, Contains(HasSubstr("vertex colours")).Times(1));
}

TEST_F(SameAsWorker, PointsThatShowAnotherStance) {
  // The shape of a flat mask does not tell that it stands on its head: the guess is wrong, and the points set it right.
  const Warnings warnings = compare(head_obj(flat_along_minus_z, true), head_points(flat_along_minus_z));
  EXPECT_THAT(warnings.import, Contains(HasSubstr("the head stands along +Z and faces +Y in its file, as far as")));
  EXPECT_THAT(warnings.package, Contains(HasSubstr("the feature points show that the head stands along -Z")));
}

TEST_F(SameAsWorker, UnsureStance) {
  const json points = {{"2.1", {{"vertex", 13}}}, {"7.1", {{"position", {4, 4, -3}}}}};
  const Warnings warnings = compare(torn_sheet_obj(), points);
  EXPECT_THAT(warnings.package, Contains(HasSubstr("axes of the head are uncertain")));
}

}  // namespace
}  // namespace semblante::test
