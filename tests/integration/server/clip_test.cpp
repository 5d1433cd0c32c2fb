#include <algorithm>
#include <csignal>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/integration/server/model_flow.h"
#include "tests/integration/server/shared_server.h"
#include "tests/integration/server/test_client.h"

namespace semblante::test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

const Fields fap_type = {{"Content-Type", "text/plain"}};

/// A performance of one cue on FAP 3, the jaw.
json jaw_performance() {
  return {{"format", "semblante.performance"},
          {"version", 1},
          {"name", "Jaw"},
          {"cues", {{{"time", 0}, {"duration", 400}, {"fap", 3}, {"value", 500}}}}};
}

/// The JSON of a GLB.
json json_of_glb(const std::string& glb) {
  const auto number = [&](std::size_t at) {
    std::uint32_t value = 0;
    for (int i = 3; i >= 0; --i)
      value = value << 8U | static_cast<std::uint8_t>(glb.at(at + static_cast<std::size_t>(i)));
    return value;
  };
  EXPECT_EQ(glb.substr(0, 4), "glTF");
  EXPECT_EQ(number(8), glb.size());
  return json::parse(glb.substr(20, number(12)));
}

class ClipRoute : public SharedServer {
 protected:
  static void SetUpTestSuite() {
    start();
    model_ = new std::string(import_grid(port(), 31));
  }
  static void TearDownTestSuite() {
    SharedServer::TearDownTestSuite();
    delete model_;
  }

  /// Asks for a clip on the suite's model, which the first call parametrizes with a smaller level of detail.
  static Reply clip(const std::string& body, const Fields& type = json_type, const std::string& query = "") {
    static const bool ready = parametrize();
    EXPECT_TRUE(ready);
    return request(port(), "POST", "/v1/models/" + *model_ + "/clip" + query, body, type);
  }

  static bool parametrize() {
    const auto path = "/v1/models/" + *model_;
    request(port(), "PUT", path + "/feature-points", grid_points(), json_type);
    const auto job = json_of(request(port(), "POST", path + "/parametrizations", R"({"lods":[400]})", json_type));
    return wait_for_job(port(), job.value("id", "")).value("state", "") == "done";
  }

  static void expect_refused(const Reply& reply, int status, const std::string& pointer) {
    EXPECT_EQ(reply.status, status) << reply.body;
    EXPECT_EQ(json_of(reply).value("pointer", ""), pointer) << reply.body;
  }

  static inline std::string* model_ = nullptr;
};

TEST_F(ClipRoute, Performance_BecomesOneAnimation) {
  const auto reply = clip(jaw_performance().dump());
  ASSERT_EQ(reply.status, 200) << reply.body;
  EXPECT_EQ(reply.headers.at("content-type"), "model/gltf-binary");
  EXPECT_THAT(reply.headers.at("content-disposition"), HasSubstr(*model_ + ".glb"));
  const auto gltf = json_of_glb(reply.body);
  ASSERT_EQ(gltf["animations"].size(), 1U);
  EXPECT_EQ(gltf["animations"][0]["name"], "Jaw");
  EXPECT_FALSE(gltf["animations"][0]["channels"].empty());
}

TEST_F(ClipRoute, Rate_IsThatOfTheFaces) {
  const auto keys = [](const std::string& query) {
    const auto gltf = json_of_glb(clip(jaw_performance().dump(), json_type, query).body);
    return gltf["asset"]["extras"]["semblante"].value("keys_unthinned", 0);
  };
  const int usual = keys("");
  ASSERT_GT(usual, 0);
  EXPECT_EQ(keys("?rate=25"), usual) << "the default";
  EXPECT_GT(keys("?rate=50"), usual * 3 / 2);
  expect_refused(clip(jaw_performance().dump(), json_type, "?rate=0"), 400, "?rate");
  expect_refused(clip(jaw_performance().dump(), json_type, "?rate=1001"), 400, "?rate");
}

TEST_F(ClipRoute, LevelOfDetail_HasFewerVertices) {
  const auto vertices = [](const std::string& query) {
    std::size_t most = 0;
    const auto gltf = json_of_glb(clip(jaw_performance().dump(), json_type, query).body);
    for (const auto& accessor : gltf["accessors"])
      if (accessor["type"] == "VEC3") most = std::max(most, accessor["count"].get<std::size_t>());
    return most;
  };
  const auto full = vertices("");
  EXPECT_GE(full, 31U * 31U);
  EXPECT_LE(vertices("?lod=1"), 400U);
  EXPECT_EQ(vertices("?max_vertices=400"), vertices("?lod=1"));
  expect_refused(clip(jaw_performance().dump(), json_type, "?lod=2"), 400, "?lod");
}

TEST_F(ClipRoute, FapFile_HasItsOwnRate) {
  std::string mask(2 * 68 - 1, ' ');
  for (std::size_t i = 0; i < mask.size(); i += 2) mask[i] = i == 4 ? '1' : '0';  // FAP 3
  const auto fap = "2.1 C:\\jaw 25 2\n" + mask + "\n0 0\n" + mask + "\n1 500\n";
  const auto reply = clip(fap, fap_type);
  ASSERT_EQ(reply.status, 200) << reply.body;
  EXPECT_EQ(json_of_glb(reply.body)["animations"].size(), 1U);
  expect_refused(clip(fap, fap_type, "?rate=50"), 400, "?rate");
  expect_refused(clip("2.1 jaw 25 1\nno mask\n", fap_type), 422, "line 2, word 1");
}

TEST_F(ClipRoute, BadBodies_AreNamed) {
  expect_refused(clip("{"), 400, "");
  expect_refused(clip("[]"), 400, "");
  expect_refused(clip(std::string(100'000, '[')), 413, "/0/0/0/0/0");
  auto body = jaw_performance();
  body["cues"][0]["fap"] = 69;
  expect_refused(clip(body.dump()), 422, "/cues/0/fap");
  body = jaw_performance();
  body.erase("cues");
  body["cues"] = json::array();
  body["idle"] = {{"seed", 1}};
  expect_refused(clip(body.dump()), 422, "/duration");  // idle life alone has no end
  body = jaw_performance();
  body["duration"] = 3'600'000;
  expect_refused(clip(body.dump()), 413, "/duration");  // 90,001 faces
  EXPECT_EQ(clip(body.dump(), json_type, "?rate=1").status, 200);
  expect_refused(clip(jaw_performance().dump(), {{"Content-Type", "text/csv"}}), 415, "");
}

TEST_F(ClipRoute, ModelWithoutAFace_IsRefused) {
  const auto body = jaw_performance().dump();
  EXPECT_EQ(request(port(), "POST", "/v1/models/absent/clip", body, json_type).status, 404);
  const auto unready = import_grid(port());
  const auto reply = request(port(), "POST", "/v1/models/" + unready + "/clip", body, json_type);
  EXPECT_EQ(reply.status, 409);
  EXPECT_THAT(reply.body, HasSubstr("not parametrized"));
}

}  // namespace
}  // namespace semblante::test
