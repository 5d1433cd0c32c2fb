// Proposals over REST, with the sample head: asked for, merged, reviewed, confirmed.

#include <algorithm>
#include <csignal>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/propose/quick_set.h"
#include "deploy/sample_head/write_sample_head.h"
#include "tests/integration/server/model_flow.h"
#include "tests/integration/server/shared_server.h"

namespace semblante::test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

class ProposalRoutes : public SharedServer {
 protected:
  static void SetUpTestSuite() {
    start();
    const SampleHead head = make_sample_head();
    const auto glb = sample_head_glb(head);
    ASSERT_TRUE(glb);
    glb_ = new std::string(glb->begin(), glb->end());
    all_ = new json(json::parse(sample_head_feature_points_json(head)));
  }
  static void TearDownTestSuite() {
    SharedServer::TearDownTestSuite();
    delete glb_;
    delete all_;
  }

  void SetUp() override {
    const auto made = json_of(
        request(port(), "POST", "/v1/models?filename=head.glb", *glb_, {{"Content-Type", "model/gltf-binary"}}));
    ASSERT_TRUE(made.contains("job")) << made;
    model_ = made["model"]["id"];
    ASSERT_EQ(wait_for_job(port(), made["job"]["id"]).value("state", ""), "done");
  }

  [[nodiscard]] std::string points_path() const { return "/v1/models/" + model_ + "/feature-points"; }

  template <class Names>
  static json points_of(const Names& names) {
    json body = {{"points", json::object()}};
    for (const auto& name : names) body["points"][std::string(name)] = (*all_)["points"][std::string(name)];
    return body;
  }
  Reply put(const json& body, const Fields& fields = json_type) const {
    return request(port(), "PUT", points_path(), body.dump(), fields);
  }
  [[nodiscard]] json points() const { return json_of(request(port(), "GET", points_path()))["points"]; }
  [[nodiscard]] Reply propose(const std::string& body = "", Fields fields = {}) const {
    if (!body.empty()) fields.insert(fields.end(), json_type.begin(), json_type.end());
    return request(port(), "POST", points_path() + "/proposals", body, fields);
  }
  /// Asks, waits, and gives the finished job.
  [[nodiscard]] json proposed() const {
    const auto job = json_of(propose());
    return job.contains("id") ? wait_for_job(port(), job["id"]) : job;
  }

  static void expect_problem(const Reply& reply, int status, const std::string& slug, const std::string& pointer = {}) {
    EXPECT_EQ(reply.status, status) << reply.body;
    EXPECT_EQ(json_of(reply).value("type", ""), "/problems/" + slug) << reply.body;
    EXPECT_EQ(json_of(reply).value("pointer", ""), pointer) << reply.body;
  }

  static inline std::string* glb_ = nullptr;
  static inline json* all_ = nullptr;
  std::string model_;
};

TEST_F(ProposalRoutes, QuickSet_BecomesAFullSetWithMarks) {
  const auto placed = json_of(put(points_of(quick_set)))["points"];
  const auto tag = request(port(), "GET", points_path()).headers.at("etag");
  const auto job = proposed();
  ASSERT_EQ(job.value("state", ""), "done") << job;
  EXPECT_EQ(job["kind"], "propose");
  EXPECT_EQ(job["result"]["proposed"], 63);  // all but the thickness of the hair
  EXPECT_THAT(job["result"]["not_proposed"]["11.5"].get<std::string>(), HasSubstr("hair"));

  const auto after = points();
  ASSERT_EQ(after.size(), 83U);
  for (const auto& [id, point] : placed.items()) EXPECT_EQ(after[id], point) << "placed points are not touched: " << id;
  EXPECT_EQ(after["8.4"]["proposed"], true);
  EXPECT_EQ(after["8.4"]["method"], "mirror");
  EXPECT_EQ(after["8.4"]["confidence"], "high");
  EXPECT_TRUE(after["8.4"]["vertex"].is_number());
  EXPECT_GT(after["8.4"]["expected_error"].get<double>(), 0.0);
  EXPECT_TRUE(after["7.1"]["position"].is_array());
  EXPECT_NE(request(port(), "GET", points_path()).headers.at("etag"), tag) << "the points have changed";
}

TEST_F(ProposalRoutes, ProposedPoints_ParametrizeLikeOthers) {
  put(points_of(quick_set));
  ASSERT_EQ(proposed().value("state", ""), "done");
  const auto job = json_of(request(port(), "POST", "/v1/models/" + model_ + "/parametrizations"));
  EXPECT_EQ(wait_for_job(port(), job["id"]).value("state", ""), "done");
  const auto rig = json_of(request(port(), "GET", "/v1/models/" + model_ + "/rig.json"));
  EXPECT_FALSE(rig.dump().empty());
  EXPECT_EQ(rig.dump().find("\"proposed\""), std::string::npos);
}

TEST_F(ProposalRoutes, Marks_SurviveARoundTripAndEndWithAPutWithoutThem) {
  put(points_of(quick_set));
  ASSERT_EQ(proposed().value("state", ""), "done");
  auto document = json_of(request(port(), "GET", points_path()));
  const auto before = document["points"];
  EXPECT_EQ(json_of(put(document))["points"], before);

  // One is confirmed, one is moved, one is thrown out.
  document["points"]["8.4"] = {{"vertex", before["8.4"]["vertex"]}};
  document["points"]["9.12"] = {{"vertex", before["9.15"]["vertex"]}};
  document["points"].erase("11.1");
  ASSERT_EQ(put(document).status, 200);
  auto now = points();
  EXPECT_FALSE(now["8.4"].contains("proposed"));
  EXPECT_FALSE(now["8.4"].contains("confidence"));
  EXPECT_EQ(now["8.5"]["proposed"], true);
  EXPECT_FALSE(now.contains("11.1"));

  // Proposed again: placed ones stay where they are, what was thrown out comes back as a proposal.
  ASSERT_EQ(proposed().value("state", ""), "done");
  now = points();
  EXPECT_FALSE(now["8.4"].contains("proposed"));
  EXPECT_EQ(now["9.12"]["vertex"], before["9.15"]["vertex"]);
  EXPECT_FALSE(now["9.12"].contains("proposed"));
  EXPECT_EQ(now["11.1"]["proposed"], true);
}

TEST_F(ProposalRoutes, WithoutPlacedPoints_ThoseOfTheShapeAreProposed) {
  const auto job = proposed();
  ASSERT_EQ(job.value("state", ""), "done") << job;
  const auto found = points();
  for (const std::string id : {"2.2", "2.3", "3.1", "3.2", "3.7", "9.3"}) {
    ASSERT_TRUE(found.contains(id)) << id;
    EXPECT_EQ(found[id]["proposed"], true) << id;
    EXPECT_EQ(found[id]["method"], "shape") << id;
  }
  EXPECT_GT(found.size(), 75U);
}

TEST_F(ProposalRoutes, PointsThatSayNothing_FailTheJobWithTheReason) {
  json body = points_of(quick_set);
  for (auto& point : body["points"]) point = body["points"]["9.3"];
  ASSERT_EQ(put(body).status, 200);
  const auto job = proposed();
  EXPECT_EQ(job.value("state", ""), "failed") << job;
  EXPECT_EQ(job["problem"]["type"], "/problems/missing-feature-points");
  EXPECT_EQ(points().size(), quick_set.size()) << "nothing was changed";
}

TEST_F(ProposalRoutes, BadRequests_NameTheFault) {
  put(points_of(quick_set));
  expect_problem(propose(R"({"which":"all"})"), 422, "invalid-field", "/which");
  expect_problem(propose("[1]"), 422, "invalid-field");
  expect_problem(propose("{"), 400, "malformed-request");
  expect_problem(propose("", {{"If-Match", "\"points-99\""}}), 412, "precondition-failed");
  const auto tag = request(port(), "GET", points_path()).headers.at("etag");
  EXPECT_EQ(propose("", {{"If-Match", tag}}).status, 202);
  EXPECT_EQ(request(port(), "GET", points_path() + "/proposals").status, 405);

  const auto with = [](const char* name, const json& value) {
    json body = {{"points", {{"2.1", {{"vertex", 4}, {"proposed", true}}}}}};
    body["points"]["2.1"][name] = value;
    return body;
  };
  expect_problem(put(with("proposed", "yes")), 422, "invalid-feature-point", "/points/2.1/proposed");
  expect_problem(put(with("method", "guess")), 422, "invalid-feature-point", "/points/2.1/method");
  expect_problem(put(with("confidence", 3)), 422, "invalid-feature-point", "/points/2.1/confidence");
  expect_problem(put(with("expected_error", -1)), 422, "invalid-feature-point", "/points/2.1/expected_error");
  expect_problem(put(with("remark", 3)), 422, "invalid-feature-point", "/points/2.1/remark");
  expect_problem(put(with("remark", std::string(501, 'x'))), 422, "invalid-feature-point", "/points/2.1/remark");
  EXPECT_EQ(json_of(put(with("remark", "joined lips")))["points"]["2.1"]["remark"], "joined lips");
  json placed = with("method", "by hand");
  placed["points"]["2.1"]["proposed"] = false;
  EXPECT_EQ(put(placed).status, 200) << "remarks of placed points are nobody's business";
  placed["points"]["2.1"]["proposed"] = nullptr;
  EXPECT_EQ(put(placed).status, 200) << "remarks of placed points are nobody's business";
}

TEST_F(ProposalRoutes, UnitsByHand_AreKeptWithThePointsAndReachThePackage) {
  auto body = points_of(quick_set);
  body["fapu"] = {{"ES", 0.07}};
  ASSERT_EQ(json_of(put(body))["fapu"], json({{"ES", 0.07}}));
  EXPECT_EQ(json_of(put(points_of(quick_set)))["fapu"], json({{"ES", 0.07}})) << "of a client that does not know them";
  const auto job = json_of(request(port(), "POST", "/v1/models/" + model_ + "/parametrizations"));
  ASSERT_EQ(wait_for_job(port(), job["id"]).value("state", ""), "done");
  const auto rig = json_of(request(port(), "GET", "/v1/models/" + model_ + "/rig.json"));
  EXPECT_NEAR(rig["fapu"]["ES"].get<double>() * 1024, 0.07, 1e-9);
  EXPECT_THAT(request(port(), "GET", "/v1/models/" + model_ + "/report.json").body, HasSubstr("unit-by-hand"));
  body["fapu"] = nullptr;
  EXPECT_EQ(json_of(put(body))["fapu"], json::object());
}

TEST_F(ProposalRoutes, HostileUnits_AreRefused) {
  const auto with = [](const char* unit, const json& value) {
    auto body = points_of(quick_set);
    body["fapu"] = {{unit, value}};
    return body;
  };
  for (const json& value : {json(0), json(-1), json(1e300), json(1e-300), json("63"), json(nullptr)})
    expect_problem(put(with("ES", value)), 422, "invalid-field", "/fapu/ES");
  expect_problem(put(with("AU", 1)), 422, "invalid-field", "/fapu/AU");
  auto body = points_of(quick_set);
  body["fapu"] = 3;
  expect_problem(put(body), 422, "invalid-field", "/fapu");
}

TEST_F(ProposalRoutes, Patch_SetsAndRemovesSinglePoints) {
  const auto patch = [&](const json& body) { return request(port(), "PATCH", points_path(), body.dump(), json_type); };
  const auto before = json_of(put(points_of(quick_set)))["points"];
  const auto changed =
      json_of(patch({{"points", {{"2.8", {{"vertex", 7}}}, {"2.1", nullptr}}}, {"fapu", {{"MW", 0.05}}}}));
  EXPECT_EQ(changed["points"]["2.8"]["vertex"], 7);
  EXPECT_FALSE(changed["points"].contains("2.1"));
  EXPECT_EQ(changed["points"]["9.15"], before["9.15"]);
  EXPECT_EQ(changed["fapu"], json({{"MW", 0.05}}));
  EXPECT_EQ(json_of(patch({{"fapu", {{"MW", nullptr}}}}))["fapu"], json::object());
  expect_problem(patch({{"points", {{"2.8", {{"vertex", -1}}}}}}), 422, "invalid-feature-point", "/points/2.8/vertex");
  expect_problem(patch({{"points", {{"1.9", nullptr}}}}), 422, "invalid-feature-point", "/points/1.9");
}

TEST_F(ProposalRoutes, IdempotencyKey_MakesOneJob) {
  put(points_of(quick_set));
  const Fields key = {{"Idempotency-Key", "once-" + model_}};
  const auto first = json_of(propose("", key));
  EXPECT_EQ(json_of(propose("", key))["id"], first["id"]);
}

}  // namespace
}  // namespace semblante::test
