#include <csignal>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "protocol/cpp/rig_document.h"
#include "protocol/cpp/weights_format.h"
#include "tests/integration/server/model_flow.h"
#include "tests/integration/server/shared_server.h"
#include "tests/integration/server/test_client.h"

namespace semblante::test {
namespace {

using nlohmann::json;

class Levels : public SharedServer {
 protected:
  static void SetUpTestSuite() { start(); }

  /// A grid with the levels asked for; its id.
  std::string grid_with(const std::string& options) {
    const auto model = import_grid(port(), 31);
    request(port(), "PUT", "/v1/models/" + model + "/feature-points", grid_points(),
            {{"Content-Type", "application/json"}});
    const auto job = json_of(request(port(), "POST", "/v1/models/" + model + "/parametrizations", options,
                                     {{"Content-Type", "application/json"}}));
    EXPECT_EQ(wait_for_job(port(), job.value("id", "")).value("state", ""), "done") << job;
    return model;
  }

  Reply get(const std::string& model, const std::string& rest) {
    return request(port(), "GET", "/v1/models/" + model + rest);
  }

  void expect_refused(const std::string& model, const std::string& rest, const std::string& parameter) {
    const auto reply = get(model, rest);
    EXPECT_EQ(reply.status, 400) << rest << ": " << reply.body;
    EXPECT_EQ(json_of(reply).value("pointer", ""), parameter) << reply.body;
  }
};

TEST_F(Levels, PointBetweenVertices_IsKeptAsItsPosition_AndHasAVertexInEachPackage) {
  const auto model = import_grid(port(), 31);
  const auto path = "/v1/models/" + model + "/feature-points";
  json body = json::parse(grid_points());
  body["points"]["2.2"] = {{"position", {0.25, 4.5, 0.0}}};
  ASSERT_EQ(request(port(), "PUT", path, body.dump(), json_type).status, 200);
  const json kept = json_of(request(port(), "GET", path))["points"]["2.2"];
  EXPECT_TRUE(kept["vertex"].is_null()) << kept;
  EXPECT_EQ(kept["position"], json::parse("[0.25, 4.5, 0.0]"));
  // What was answered can be sent back.
  body["points"]["2.2"] = kept;
  ASSERT_EQ(request(port(), "PUT", path, body.dump(), json_type).status, 200);

  const auto job =
      json_of(request(port(), "POST", "/v1/models/" + model + "/parametrizations", R"({"lods":[400]})", json_type));
  const json done = wait_for_job(port(), job.value("id", ""));
  ASSERT_EQ(done.value("state", ""), "done") << done;
  for (const std::size_t lod : {0U, 1U}) {
    const auto rig = read_rig(get(model, "/rig.json?lod=" + std::to_string(lod)).body);
    ASSERT_TRUE(rig) << rig.error().where << " " << rig.error().message;
    if (lod == 0) {
      EXPECT_EQ(rig->mesh.vertices, 31U * 31U + 1U);
    }
    const auto point = std::find_if(rig->feature_points.begin(), rig->feature_points.end(),
                                    [](const auto& one) { return to_string(one.id) == "2.2"; });
    ASSERT_NE(point, rig->feature_points.end());
    EXPECT_TRUE(point->vertex);
    EXPECT_NEAR(point->position[0], 0.25, 1e-5);
    EXPECT_NEAR(point->position[1], 4.5, 1e-5);
  }
  // Numbers are those of the file: the point's own vertex has none.
  EXPECT_EQ(json_of(get(model, ""))["counts"]["vertices"], 31 * 31) << get(model, "").body;
  body["points"]["2.2"] = {{"vertex", 31 * 31}};
  EXPECT_EQ(request(port(), "PUT", path, body.dump(), json_type).status, 422);
}

TEST_F(Levels, EachIsAPackageOfItsOwn) {
  const auto model = grid_with(R"({"lods":[400,150]})");
  const auto package = json_of(get(model, ""))["package"];
  ASSERT_EQ(package["levels"].size(), 3U) << package;
  EXPECT_EQ(package["levels"][0]["artefacts"], package["artefacts"]);
  for (std::size_t lod = 0; lod < 3; ++lod) {
    const auto& level = package["levels"][lod];
    EXPECT_EQ(level["lod"], lod);
    const auto query = "?lod=" + std::to_string(lod);
    const auto rig_json = get(model, "/rig.json" + query);
    const auto rig = read_rig(rig_json.body);
    ASSERT_TRUE(rig) << rig.error().where << " " << rig.error().message;
    EXPECT_EQ(rig->lod, lod);
    ASSERT_EQ(rig->levels.size(), 3U);
    EXPECT_EQ(rig->mesh.vertices, level["vertices"]);
    EXPECT_EQ(rig->levels[lod].vertices, rig->mesh.vertices);
    EXPECT_EQ(rig->levels[lod].bytes, rig->mesh.bytes + rig->weights.bytes);
    const auto weights = get(model, "/weights" + query);
    const auto table =
        decode_weights({reinterpret_cast<const std::uint8_t*>(weights.body.data()), weights.body.size()});
    ASSERT_TRUE(table);
    EXPECT_EQ(table->mesh_sha256, rig->mesh.sha256);
    EXPECT_EQ(table->vertex_count, rig->mesh.vertices);
    const auto mesh = get(model, "/mesh.drc" + query);
    EXPECT_EQ(mesh.headers.at("etag"), "\"sha256-" + to_hex(rig->mesh.sha256) + "\"");
    EXPECT_EQ(get(model, "/face.glb" + query).body.substr(0, 4), "glTF");
    for (const auto& point : rig->feature_points) EXPECT_TRUE(point.vertex) << to_string(point.id);
  }
  EXPECT_LE(package["levels"][1]["vertices"], 400);
  EXPECT_LE(package["levels"][2]["vertices"], 150);
  // Every link leads to the bytes it names.
  for (const auto& [name, artefact] : package["levels"][2]["artefacts"].items()) {
    EXPECT_EQ(request(port(), "GET", artefact["href"]).headers.at("etag"),
              "\"sha256-" + artefact["sha256"].get<std::string>() + "\"");
  }
}

TEST_F(Levels, AreChosenByHowManyVerticesFit) {
  const auto model = grid_with(R"({"lods":[400,150]})");
  const auto lod_for = [&](const std::string& most) {
    return json_of(get(model, "/rig.json?max_vertices=" + most)).value("lod", -1);
  };
  EXPECT_EQ(lod_for("100000"), 0);
  EXPECT_EQ(lod_for("400"), 1);
  EXPECT_EQ(lod_for("399"), json_of(get(model, ""))["package"]["levels"][1]["vertices"] <= 399 ? 1 : 2);
  EXPECT_EQ(lod_for("150"), 2);
  EXPECT_EQ(lod_for("1"), 2);  // none fits: the smallest
}

TEST_F(Levels, RefusalsNameTheParameter) {
  const auto model = grid_with(R"({"lods":[400]})");
  expect_refused(model, "/mesh.drc?lod=2", "?lod");
  expect_refused(model, "/weights?lod=-1", "?lod");
  expect_refused(model, "/rig.json?lod=", "?lod");
  expect_refused(model, "/face.glb?max_vertices=many", "?max_vertices");
  expect_refused(model, "/mesh.drc?max_vertices=0", "?max_vertices");
  expect_refused(model, "/mesh.drc?lod=1&max_vertices=100", "?max_vertices");
  expect_refused(model, "/preview.glb?lod=7", "?lod");  // has no levels

  const std::vector<std::pair<std::string, std::string>> bad = {
      {R"({"lods":5000})", "/lods"},
      {R"({"lods":[500,99]})", "/lods/1"},
      {R"({"lods":[500,500]})", "/lods/1"},
      {R"({"lods":[1e9]})", "/lods/0"},
      {R"({"lods":[900,800,700,600,500,400,300,200,100]})", "/lods"}};
  for (const auto& [body, pointer] : bad) {
    const auto reply = request(port(), "POST", "/v1/models/" + model + "/parametrizations", body,
                               {{"Content-Type", "application/json"}});
    EXPECT_EQ(reply.status, 422) << body;
    EXPECT_EQ(json_of(reply).value("pointer", ""), pointer) << body;
  }
}

TEST_F(Levels, TheReportSaysHowFarTheyAre) {
  const auto model = grid_with(R"({"lods":[400,150]})");
  const auto report = json_of(get(model, "/report.json"))["levels_of_detail"];
  ASSERT_EQ(report["levels"].size(), 2U) << report;
  EXPECT_EQ(report["levels"][0]["budget"], 400);
  EXPECT_EQ(report["levels"][1]["expressions"].size(), 6U);
  EXPECT_GE(report["levels"][1]["neutral"]["max"], report["levels"][1]["neutral"]["mean"]);
  EXPECT_EQ(report["levels"][1]["flipped_triangles"], 0);
  EXPECT_TRUE(report["missed"].empty());
}

TEST_F(Levels, OneThatCannotBeIsExplained) {
  const auto model = grid_with(R"({"lods":[5000]})");
  const auto facts = json_of(get(model, ""));
  EXPECT_EQ(facts["package"]["levels"].size(), 1U);
  EXPECT_THAT(facts["warnings"].dump(), ::testing::HasSubstr("no level of 5000 vertices"));
  EXPECT_EQ(json_of(get(model, "/report.json"))["levels_of_detail"]["missed"][0]["budget"], 5000);
}

TEST_F(Levels, AreMadeOnRequestAlone) {
  for (const char* const options : {"{}", R"({"lods":[]})", R"({"lods":"auto"})"}) {  // a light model needs none
    const auto model = grid_with(options);
    EXPECT_EQ(json_of(get(model, ""))["package"]["levels"].size(), 1U);
    EXPECT_FALSE(json_of(get(model, "/rig.json")).contains("levels"));
    EXPECT_EQ(get(model, "/mesh.drc?lod=0").status, 200);
  }
}

}  // namespace
}  // namespace semblante::test
