// Displacement sets over REST: taken from examples, made by hand, worn by models.

#include <csignal>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/integration/server/model_flow.h"
#include "tests/integration/server/shared_server.h"

namespace semblante::test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

/// On the 9 by 9 grid of grid_obj: MW0 4 (8.3 to 8.4), MNS0 2 (9.15 to 2.2).
constexpr const char* face_points =
    R"({"points":{"2.1":{"vertex":13},"2.2":{"vertex":40},"8.3":{"vertex":33},"8.4":{"vertex":29},"9.15":{"vertex":58}}})";

/// The grid with 8.3 (vertex 33, at 2 3 0) moved by 1, -0.5, 0; vertices alone.
std::string smile_obj(const std::string& at_33 = "3 2.5 0") {
  const std::string grid = grid_obj(9);
  const auto at = grid.find("v 2 3 0\n");
  return grid.substr(0, at) + "v " + at_33 + grid.substr(at + 7, grid.find("f ") - at - 7);
}

struct Part {
  std::string name, content, file_name = "";
};

std::string form(const std::vector<Part>& parts) {
  std::string body;
  for (const auto& part : parts) {
    body += "--border\r\nContent-Disposition: form-data; name=\"" + part.name + "\"";
    if (!part.file_name.empty()) body += "; filename=\"" + part.file_name + "\"";
    body += "\r\n\r\n" + part.content + "\r\n";
  }
  return body + "--border--\r\n";
}

std::string base64(std::string_view bytes) {
  static constexpr std::string_view alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 3; ++k)
      word = word << 8U | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k) text += i + k <= bytes.size() ? alphabet[word >> (18U - 6U * k) & 63U] : '=';
  }
  return text;
}

/// The grid as glTF with two morph targets: "smile" moves vertex 33 by 1 -0.5 0, "drop" vertex 13 by 0 -1 0.
std::string gltf_with_targets(const char* first = "smile", const char* second = "drop") {
  std::string bin;
  const auto put = [&](auto value) { bin.append(reinterpret_cast<const char*>(&value), sizeof value); };
  for (int v = 0; v < 81; ++v) {
    put(static_cast<float>(v % 9 - 4));
    put(static_cast<float>(v / 9));
    put(0.0F);
  }
  const auto target = [&](int moved, float x, float y) {
    for (int v = 0; v < 81; ++v) {
      put(v == moved ? x : 0.0F);
      put(v == moved ? y : 0.0F);
      put(0.0F);
    }
  };
  target(33, 1.0F, -0.5F);
  target(13, 0.0F, -1.0F);
  int indices = 0;
  for (int row = 0; row < 8; ++row) {
    for (int column = 0; column < 8; ++column) {
      const int a = 9 * row + column;
      for (const int corner : {a, a + 1, a + 10, a, a + 10, a + 9}) {
        put(static_cast<std::uint16_t>(corner));
        ++indices;
      }
    }
  }
  const json accessor = {{"componentType", 5126}, {"count", 81}, {"type", "VEC3"}};
  json document = {
      {"asset", {{"version", "2.0"}}},
      {"buffers", {{{"byteLength", bin.size()}, {"uri", "data:application/octet-stream;base64," + base64(bin)}}}},
      {"bufferViews", json::array()},
      {"accessors", json::array()}};
  for (int i = 0; i < 3; ++i) {
    document["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", 972 * i}, {"byteLength", 972}});
    document["accessors"].push_back(accessor);
    document["accessors"].back()["bufferView"] = i;
    if (i == 0) {
      document["accessors"].back()["min"] = {-4, 0, 0};
      document["accessors"].back()["max"] = {4, 8, 0};
    }
  }
  document["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", 2916}, {"byteLength", 2 * indices}});
  document["accessors"].push_back({{"bufferView", 3}, {"componentType", 5123}, {"count", indices}, {"type", "SCALAR"}});
  document["meshes"] = {
      {{"primitives",
        {{{"attributes", {{"POSITION", 0}}}, {"indices", 3}, {"targets", {{{"POSITION", 1}}, {{"POSITION", 2}}}}}}},
       {"extras", {{"targetNames", {first, second}}}}}};
  document["nodes"] = {{{"mesh", 0}}};
  document["scenes"] = {{{"nodes", {0}}}};
  document["scene"] = 0;
  return document.dump();
}

class ExpressionRoutes : public SharedServer {
 protected:
  static void SetUpTestSuite() { start({"--max-upload-bytes", "300000", "--max-expressions", "60"}); }

  static std::string model_with(const std::string& file, const std::string& name, const std::string& type) {
    const auto made = json_of(request(port(), "POST", "/v1/models?filename=" + name, file, {{"Content-Type", type}}));
    EXPECT_TRUE(made.contains("job")) << made;
    EXPECT_EQ(wait_for_job(port(), made["job"]["id"]).value("state", ""), "done");
    const std::string model = made["model"]["id"];
    EXPECT_EQ(request(port(), "PUT", "/v1/models/" + model + "/feature-points", face_points, json_type).status, 200);
    return model;
  }
  static std::string grid_model() { return model_with(grid_obj(9), "grid.obj", "model/obj"); }
  static std::string target_model() { return model_with(gltf_with_targets(), "grid.gltf", "model/gltf+json"); }

  static Reply post(const json& body, Fields fields = {}) {
    fields.insert(fields.end(), json_type.begin(), json_type.end());
    return request(port(), "POST", "/v1/expressions", body.dump(), fields);
  }
  static Reply post_form(const std::vector<Part>& parts, Fields fields = {}) {
    fields.insert(fields.end(), form_type.begin(), form_type.end());
    return request(port(), "POST", "/v1/expressions", form(parts), fields);
  }
  /// Follows the job of a 202 to its end.
  static json finished(const Reply& reply) {
    EXPECT_EQ(reply.status, 202) << reply.body;
    if (reply.status != 202) return json_of(reply);
    EXPECT_EQ(reply.headers.at("location"), "/v1/jobs/" + json_of(reply)["id"].get<std::string>());
    return wait_for_job(port(), json_of(reply)["id"]);
  }
  static json set_of(const json& job) {
    EXPECT_EQ(job.value("state", ""), "done") << job;
    if (job.value("state", "") != "done") return json::object();
    EXPECT_EQ(job["kind"], "extract");
    return json_of(request(port(), "GET", job["result"]["href"]));
  }
  static std::string made_by_hand(const std::string& kind = "expression", const std::string& name = "Grin") {
    return json_of(post({{"name", name}, {"kind", kind}, {"displacements", {{"8.3", {256, -256, 0}}}}}))["id"];
  }
  static void expect_problem(const Reply& reply, int status, const std::string& slug, const std::string& pointer = {}) {
    EXPECT_EQ(reply.status, status) << reply.body;
    EXPECT_EQ(json_of(reply).value("type", ""), "/problems/" + slug) << reply.body;
    EXPECT_EQ(json_of(reply).value("pointer", ""), pointer) << reply.body;
  }
};

// 1 / (4 / 1024), -0.5 / (2 / 1024)
const json smile = {{"8.3", {256, -256, 0}}};

TEST_F(ExpressionRoutes, AStoredModelAndAFileOfItsVertices_GiveASet) {
  const auto model = grid_model();
  const auto job =
      finished(post_form({{"options", json({{"model", model}, {"kind", "viseme"}, {"strength", 0.5}}).dump()},
                          {"expression", smile_obj(), "smile.obj"}}));
  const auto set = set_of(job);
  EXPECT_EQ(job["model"], model);
  EXPECT_EQ(job["result"]["points"], 1);
  EXPECT_EQ(job["result"]["at_rest"], (json{"2.1", "2.2", "8.4", "9.15"}));
  EXPECT_EQ(job["result"]["not_marked"].size(), 79U);
  EXPECT_EQ(set["name"], "smile");
  EXPECT_EQ(set["kind"], "viseme");
  EXPECT_EQ(set["displacements"], (json{{"8.3", {512, -512, 0}}}));
  EXPECT_EQ(set["source"]["model"], model);
  EXPECT_EQ(set["source"]["expression_file"], "smile.obj");
  EXPECT_EQ(set["source"]["strength"], 0.5);
  EXPECT_EQ(set["built_in"], false);
}

TEST_F(ExpressionRoutes, TwoFilesAndPoints_NeedNoModel) {
  const std::vector<Part> parts = {{"options", R"({"name":"Ana's smile"})"},
                                   {"neutral", grid_obj(9), "grid.obj"},
                                   {"expression", smile_obj(), "smile.obj"},
                                   {"feature_points", face_points}};
  const auto models = json_of(request(port(), "GET", "/v1/models?limit=200"))["models"].size();
  const auto job = finished(post_form(parts));
  EXPECT_EQ(job["model"], nullptr);
  EXPECT_EQ(set_of(job)["displacements"], smile);
  EXPECT_EQ(set_of(job)["name"], "Ana's smile");
  EXPECT_EQ(json_of(request(port(), "GET", "/v1/models?limit=200"))["models"].size(), models);
}

TEST_F(ExpressionRoutes, MorphTargets_AreNamed) {
  const auto model = target_model();
  EXPECT_EQ(set_of(finished(post({{"model", model}, {"target", "smile"}})))["displacements"], smile);
  const auto between = set_of(finished(post({{"model", model}, {"target", "smile"}, {"from", "drop"}})));
  // From the chin down by 1 to where it was: 1 / (2 / 1024).
  EXPECT_EQ(between["displacements"], (json{{"2.1", {0, 512, 0}}, {"8.3", {256, -256, 0}}}));
  const auto unknown = post({{"model", model}, {"target", "grin"}});
  expect_problem(unknown, 422, "invalid-field", "/target");
  EXPECT_THAT(json_of(unknown)["detail"].get<std::string>(), HasSubstr("it has smile, drop"));
  expect_problem(post({{"model", model}, {"target", "smile"}, {"from", "grin"}}), 422, "invalid-field", "/from");
}

TEST_F(ExpressionRoutes, BadExamples_AreRefusedAtOnceOrFailTheirJob) {
  const auto model = grid_model();
  const std::string options = json({{"model", model}}).dump();
  const auto with = [&](const std::string& file) {
    return finished(post_form({{"options", options}, {"expression", file, "smile.obj"}}));
  };
  const auto expect_failed = [](const json& job, const std::string& slug, const std::string& pointer,
                                const std::string& words) {
    EXPECT_EQ(job.value("state", ""), "failed") << job;
    EXPECT_EQ(job["problem"]["type"], "/problems/" + slug) << job;
    EXPECT_EQ(job["problem"].value("pointer", ""), pointer) << job;
    EXPECT_THAT(job["problem"]["detail"].get<std::string>(), HasSubstr(words));
  };
  expect_failed(with(grid_obj(5)), "invalid-field", "/expression", "25 vertices, the neutral head 81");
  expect_failed(with(grid_obj(9)), "invalid-field", "/expression", "moves none of the marked");
  expect_failed(with(smile_obj("nan 0 0")), "malformed-model", "line 35", "not a finite number");
  expect_failed(with(smile_obj("1e30 0 0")), "malformed-model", "vertex 33", "larger than 1e15");
  expect_failed(with(smile_obj("1e9 0 0")), "invalid-field", "/expression", "the same unit");
  // The same vertices, but faces of another order: numbered otherwise.
  std::string other = smile_obj();
  for (int i = 1; i <= 64; ++i) {
    const auto v = [&](int k) { return std::to_string((i * 37 + k * 29) % 81 + 1); };
    other += "f " + v(0) + " " + v(1) + " " + v(2) + "\n";
  }
  expect_failed(with(other), "invalid-field", "/expression", "another order");

  expect_problem(post_form({{"options", options}}), 422, "invalid-field", "/expression");
  expect_problem(post_form({{"expression", smile_obj(), "a.obj"}}), 422, "invalid-field", "/neutral");
  expect_problem(post_form({{"options", options}, {"neutral", grid_obj(9)}, {"expression", smile_obj()}}), 422,
                 "invalid-field", "/neutral");
  expect_problem(post_form({{"neutral", grid_obj(9), "a.obj"}, {"expression", smile_obj(), "a.obj"}}), 422,
                 "missing-feature-points", "/feature_points");
  expect_problem(post_form({{"neutral", grid_obj(9), "a.obj"},
                            {"expression", smile_obj(), "a.obj"},
                            {"feature_points", R"({"points":{"2.99":{"vertex":1}}})"}}),
                 422, "invalid-feature-point", "/feature_points/points/2.99");
  expect_problem(post_form({{"options", options}, {"expression", "", "a.obj"}}), 422, "empty-model", "/expression");
  expect_problem(post_form({{"options", options}, {"expression", "what?"}}), 422, "unsupported-model", "/expression");
  expect_problem(post_form({{"options", "{"}, {"expression", smile_obj()}}), 400, "malformed-request");
  const auto large = post_form({{"options", options}, {"expression", std::string(400'000, 'v')}});
  expect_problem(large, 413, "content-too-large");
  EXPECT_EQ(json_of(large).value("advice", ""), "reduce-model");
  expect_problem(request(port(), "POST", "/v1/expressions", "x", {{"Content-Type", "model/obj"}}), 415,
                 "unsupported-media-type");

  expect_problem(post(json::object()), 422, "invalid-field", "/model");
  expect_problem(post({{"model", "absent"}, {"target", "smile"}}), 422, "invalid-field", "/model");
  expect_problem(post({{"model", model}}), 422, "invalid-field", "/target");
  expect_problem(post({{"model", model}, {"target", "smile"}}), 422, "invalid-field", "/target");
  expect_problem(post({{"model", model}, {"target", "smile"}, {"mood", 1}}), 422, "invalid-field", "/mood");
  expect_problem(post({{"model", model}, {"target", "smile"}, {"kind", "mood"}}), 422, "invalid-field", "/kind");
  expect_problem(post({{"model", model}, {"target", "smile"}, {"align", 1}}), 422, "invalid-field", "/align");
  expect_problem(post({{"model", model}, {"target", "smile"}, {"least", -1}}), 422, "invalid-field", "/least");
  expect_problem(post({{"model", model}, {"target", "smile"}, {"strength", 0}}), 422, "invalid-field", "/strength");
  const auto bare = import_grid(port());
  expect_problem(post({{"model", bare}, {"target", "smile"}}), 422, "missing-feature-points", "/model");
}

TEST_F(ExpressionRoutes, ASetByHand_IsKeptReadEditedAndRemoved) {
  const json body = {{"name", "Grin"}, {"displacements", {{"8.3", {100.5, 0, 0}}, {"2.1", {0, -5, 0.1}}}}};
  const auto made = post(body);
  ASSERT_EQ(made.status, 201) << made.body;
  const std::string path = made.headers.at("location");
  auto set = json_of(made);
  EXPECT_EQ(set["displacements"], (json{{"2.1", {0, -5, 0.1}}, {"8.3", {100.5, 0, 0}}}));
  EXPECT_EQ(set["source"], nullptr);
  const auto got = request(port(), "GET", path);
  EXPECT_EQ(json_of(got), set);
  EXPECT_EQ(request(port(), "GET", path, {}, {{"If-None-Match", got.headers.at("etag")}}).status, 304);

  // What was read can be edited and sent back.
  set["displacements"]["2.1"][1] = -50;
  set["name"] = "Broad grin";
  const auto put = [&](const json& changed, Fields fields = {}) {
    fields.insert(fields.end(), json_type.begin(), json_type.end());
    return request(port(), "PUT", path, changed.dump(), fields);
  };
  expect_problem(put(set, {{"If-Match", "\"set-7\""}}), 412, "precondition-failed");
  const auto edited = put(set, {{"If-Match", got.headers.at("etag")}});
  ASSERT_EQ(edited.status, 200) << edited.body;
  EXPECT_EQ(json_of(edited)["revision"], 2);
  EXPECT_EQ(json_of(edited)["displacements"]["2.1"], (json{0, -50, 0.1}));
  EXPECT_NE(edited.headers.at("etag"), got.headers.at("etag"));

  for (const auto& [pointer, wrong] : std::vector<std::pair<std::string, json>>{
           {"/name", {{"displacements", json::object()}}},
           {"/displacements", {{"name", "x"}}},
           {"/kind", {{"name", "x"}, {"kind", "mood"}, {"displacements", json::object()}}},
           {"/displacements/2.99", {{"name", "x"}, {"displacements", {{"2.99", {0, 0, 0}}}}}},
           {"/displacements/2.1", {{"name", "x"}, {"displacements", {{"2.1", {0, 0}}}}}},
           {"/displacements/2.1/2", {{"name", "x"}, {"displacements", {{"2.1", {0, 0, "1"}}}}}},
           {"/displacements/2.1", {{"name", "x"}, {"displacements", {{"2.1", {0, 1e9, 0}}}}}},
           {"/more", {{"name", "x"}, {"more", 1}, {"displacements", json::object()}}}}) {
    expect_problem(put(wrong), 422, "invalid-field", pointer);
  }
  expect_problem(request(port(), "PUT", path, R"({"name":"x","displacements":{"2.1":[0,1e999,0]}})", json_type), 400,
                 "malformed-request", "/displacements/2.1/1");

  EXPECT_EQ(request(port(), "DELETE", path).status, 204);
  expect_problem(request(port(), "GET", path), 404, "not-found");
}

TEST_F(ExpressionRoutes, TheLibrary_IsReadAndStays) {
  const auto list = json_of(request(port(), "GET", "/v1/expressions"));
  EXPECT_EQ(list["visemes"].size(), 15U);
  EXPECT_EQ(list["expressions"][1], "joy");
  const auto joy = request(port(), "GET", "/v1/expressions/joy");
  EXPECT_EQ(json_of(joy)["built_in"], true);
  EXPECT_GT(json_of(joy)["displacements"].size(), 5U);
  EXPECT_EQ(request(port(), "GET", "/v1/expressions/joy", {}, {{"If-None-Match", joy.headers.at("etag")}}).status, 304);
  EXPECT_EQ(json_of(request(port(), "GET", "/v1/expressions/p_b_m"))["kind"], "viseme");
  expect_problem(request(port(), "DELETE", "/v1/expressions/joy"), 409, "conflict");
  expect_problem(request(port(), "PUT", "/v1/expressions/joy", R"({"name":"x","displacements":{}})", json_type), 409,
                 "conflict");
}

TEST_F(ExpressionRoutes, Lists_ComeInPages_AndTheirNumberHasALimit) {
  made_by_hand("expression", "one");
  made_by_hand("expression", "two");
  std::vector<std::string> names;
  std::string after;
  do {
    const auto page = json_of(request(port(), "GET", "/v1/expressions?limit=1" + after));
    ASSERT_EQ(page["sets"].size(), 1U);
    EXPECT_FALSE(page["sets"][0].contains("displacements"));
    names.push_back(page["sets"][0]["name"]);
    after = page["next"].is_null() ? "" : "&after=" + page["next"].get<std::string>();
  } while (!after.empty());
  ASSERT_GE(names.size(), 2U);
  EXPECT_EQ(names[names.size() - 2], "one");
  EXPECT_EQ(names.back(), "two");
  expect_problem(request(port(), "GET", "/v1/expressions?limit=0"), 400, "invalid-argument", "?limit");
  expect_problem(request(port(), "GET", "/v1/expressions?after=absent"), 400, "invalid-argument", "?after");
  const TemporaryFolder folder;
  const ServerProcess small(folder.path() / "data", {"--max-expressions", "1"});
  const std::string body = R"({"name":"x","displacements":{}})";
  EXPECT_EQ(request(small.port(), "POST", "/v1/expressions", body, json_type).status, 201);
  EXPECT_EQ(request(small.port(), "POST", "/v1/expressions", body, json_type).status, 507);
}

TEST_F(ExpressionRoutes, IdempotencyKeys_MakeASetOnce) {
  const json body = {{"name", "Once"}, {"displacements", json::object()}};
  const auto first = post(body, {{"Idempotency-Key", "by-hand"}});
  EXPECT_EQ(json_of(post(body, {{"Idempotency-Key", "by-hand"}}))["id"], json_of(first)["id"]);
  expect_problem(post({{"name", "Twice"}, {"displacements", json::object()}}, {{"Idempotency-Key", "by-hand"}}), 422,
                 "idempotency-key-reused");
  const std::vector<Part> parts = {
      {"neutral", grid_obj(9), "grid.obj"}, {"expression", smile_obj(), "smile.obj"}, {"feature_points", face_points}};
  const auto job = post_form(parts, {{"Idempotency-Key", "example"}});
  const auto again = post_form(parts, {{"Idempotency-Key", "example"}});
  EXPECT_EQ(again.status, 202);
  EXPECT_EQ(json_of(job)["id"], json_of(again)["id"]);
  EXPECT_EQ(finished(job)["result"], finished(again)["result"]);
}

TEST_F(ExpressionRoutes, AModelWearsItsOwnShapes_ByOneRequest) {
  const auto model = model_with(gltf_with_targets("happy", "viseme_aa"), "own.gltf", "model/gltf+json");
  const auto path = "/v1/models/" + model;
  const auto ask = [&](const std::string& of, const char* body, Fields fields = {}) {
    fields.insert(fields.end(), json_type.begin(), json_type.end());
    return request(port(), "POST", "/v1/models/" + of + "/parametrizations", body, fields);
  };
  const auto worn = [&](const char* list, const char* name) -> json {
    const auto document = json_of(request(port(), "GET", path + "/rig.json"));
    for (const auto& entry : document[list])
      if (entry["name"] == name) return entry["displacements"];
    return nullptr;
  };
  const auto* const wish = R"({"weights":"fitted","expressions":"own"})";
  const auto made = json_of(ask(model, wish, {{"Idempotency-Key", "own"}}));
  ASSERT_EQ(wait_for_job(port(), made["id"]).value("state", ""), "done") << made;
  EXPECT_EQ(json_of(ask(model, wish, {{"Idempotency-Key", "own"}}))["id"], made["id"]);
  EXPECT_EQ(worn("expressions", "joy"), (json{{"8.3", {1.0, -0.5, 0.0}}}));
  EXPECT_EQ(worn("visemes", "a"), (json{{"2.1", {0.0, -1.0, 0.0}}}));
  const auto told = json_of(request(port(), "GET", path));
  EXPECT_THAT(told["warnings"].dump(), HasSubstr("a (viseme_aa), joy (happy)"));
  EXPECT_THAT(told["warnings"].dump(), HasSubstr("it has no shapes for p_b_m"));
  const auto report = json_of(request(port(), "GET", path + "/report.json"));
  ASSERT_EQ(report["weight_fit"]["shapes"].size(), 2U) << report;
  EXPECT_EQ(report["weight_fit"]["shapes"][0]["name"], "happy");
  EXPECT_EQ(report["articulation"]["value"], 1) << "its viseme_aa does not move the lips' points";

  // What is chosen by hand stays, and the rest stays its own when the package is made again.
  const auto again =
      request(port(), "PATCH", path, json({{"expressions", {{"joy", made_by_hand()}}}}).dump(), json_type);
  ASSERT_EQ(again.status, 202) << again.body;
  wait_for_job(port(), json_of(request(port(), "GET", again.headers.at("location")))["id"]);
  EXPECT_EQ(worn("visemes", "a"), (json{{"2.1", {0.0, -1.0, 0.0}}}));
  EXPECT_EQ(json_of(request(port(), "GET", path))["package"]["weights"], "fitted");

  const auto bare = grid_model();
  expect_problem(ask(bare, R"({"weights":"fitted"})"), 422, "invalid-field", "/weights");
  expect_problem(ask(bare, R"({"expressions":"own"})"), 422, "invalid-field", "/expressions");
  expect_problem(ask(bare, R"({"expressions":"mine"})"), 422, "invalid-field", "/expressions");
  const auto unnamed = target_model();
  const auto failed = wait_for_job(port(), json_of(ask(unnamed, R"({"expressions":"own"})"))["id"]);
  EXPECT_EQ(failed.value("state", ""), "failed");
  EXPECT_THAT(failed["problem"].dump(), HasSubstr("is a viseme or expression by its name"));
}

TEST_F(ExpressionRoutes, AModelWearsASet_AsItWas_UntilItIsTakenOff) {
  const auto model = grid_model();
  const auto path = "/v1/models/" + model;
  const auto set = made_by_hand();
  const auto viseme = made_by_hand("viseme", "Ah");
  const auto patch = [&](const json& expressions) {
    return request(port(), "PATCH", path, json({{"expressions", expressions}}).dump(), json_type);
  };
  const auto rig = [&] { return request(port(), "GET", path + "/rig.json"); };
  const auto worn = [&](const char* list, const char* name) -> json {
    const auto document = json_of(rig());
    for (const auto& entry : document[list])
      if (entry["name"] == name) return entry["displacements"];
    return nullptr;
  };

  // Before there is a package the next one will have it.
  const auto early = patch({{"joy", set}});
  ASSERT_EQ(early.status, 200) << early.body;
  EXPECT_EQ(json_of(early)["expressions"]["joy"], (json{{"expression", set}, {"name", "Grin"}, {"revision", 1}}));
  const auto made =
      json_of(request(port(), "POST", path + "/parametrizations", R"({"weight_bits":10,"articulation":2})", json_type));
  ASSERT_EQ(wait_for_job(port(), made["id"]).value("state", ""), "done");
  // 256 units of 4 / 1024, and of 2 / 1024.
  EXPECT_EQ(worn("expressions", "joy"), (json{{"8.3", {1.0, -0.5, 0.0}}}));
  const auto with_joy = rig();
  const auto on_model = json_of(request(port(), "GET", "/v1/expressions/" + set + "?model=" + model))["on_model"];
  EXPECT_EQ(on_model["displacements"], worn("expressions", "joy"));
  expect_problem(request(port(), "GET", "/v1/expressions/" + set + "?model=absent"), 400, "invalid-argument", "?model");

  // With a package it is made again, with the same options.
  const auto accepted = patch({{"a", viseme}});
  ASSERT_EQ(accepted.status, 202) << accepted.body;
  const auto job = json_of(request(port(), "GET", accepted.headers.at("location")));
  EXPECT_EQ(job["kind"], "parametrize");
  ASSERT_EQ(wait_for_job(port(), job["id"]).value("state", ""), "done");
  EXPECT_EQ(json_of(request(port(), "GET", path))["package"]["weight_bits"], 10);
  EXPECT_EQ(json_of(rig())["articulation"], 2);
  const auto report = json_of(request(port(), "GET", path + "/report.json"));
  EXPECT_EQ(report["articulation"], (json{{"value", 2}, {"reason", "set by hand"}}));
  EXPECT_EQ(worn("visemes", "a"), (json{{"8.3", {1.0, -0.5, 0.0}}}));
  EXPECT_EQ(worn("expressions", "joy"), (json{{"8.3", {1.0, -0.5, 0.0}}}));
  EXPECT_NE(rig().headers.at("etag"), with_joy.headers.at("etag"));

  // What happens to the sets is no matter to the face.
  EXPECT_EQ(request(port(), "DELETE", "/v1/expressions/" + set).status, 204);
  EXPECT_EQ(request(port(), "PUT", "/v1/expressions/" + viseme, R"({"name":"Oh","kind":"viseme","displacements":{}})",
                    json_type)
                .status,
            200);
  const auto off = patch({{"a", nullptr}});
  ASSERT_EQ(off.status, 202);
  wait_for_job(port(), json_of(request(port(), "GET", off.headers.at("location")))["id"]);
  EXPECT_EQ(rig().headers.at("etag"), with_joy.headers.at("etag")) << "the same face has the same hash";
  EXPECT_EQ(json_of(request(port(), "GET", path))["expressions"].size(), 1U);

  expect_problem(patch({{"joy", viseme}}), 422, "invalid-field", "/expressions/joy");
  expect_problem(patch({{"joy", "absent"}}), 422, "invalid-field", "/expressions/joy");
  expect_problem(patch({{"joy", 3}}), 422, "invalid-field", "/expressions/joy");
  for (const char* const slot : {"mood", "sil", "none"})
    expect_problem(patch({{slot, viseme}}), 422, "invalid-field", std::string("/expressions/") + slot);
  expect_problem(patch(json::array()), 422, "invalid-field", "/expressions");
}

TEST(ExpressionDurability, SetsAndExtractionsSurviveKill) {
  const TemporaryFolder folder;
  std::string set, before, job;
  {
    ServerProcess server(folder.path() / "data");
    set = json_of(request(server.port(), "POST", "/v1/expressions",
                          R"({"name":"Kept","displacements":{"2.1":[0,-5,0.1]}})", json_type))["id"];
    before = request(server.port(), "GET", "/v1/expressions/" + set).body;
    const auto accepted = request(server.port(), "POST", "/v1/expressions",
                                  form({{"neutral", grid_obj(9), "grid.obj"},
                                        {"expression", smile_obj(), "smile.obj"},
                                        {"feature_points", face_points}}),
                                  form_type);
    ASSERT_EQ(accepted.status, 202);
    job = json_of(accepted)["id"];
    server.end(SIGKILL);
  }
  ServerProcess server(folder.path() / "data");
  EXPECT_EQ(request(server.port(), "GET", "/v1/expressions/" + set).body, before);
  const auto done = wait_for_job(server.port(), job);
  ASSERT_EQ(done.value("state", ""), "done") << done;
  EXPECT_EQ(json_of(request(server.port(), "GET", done["result"]["href"]))["displacements"], smile);
  // The files were the job's; they go with it.
  std::size_t blobs = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder.path() / "data" / "blobs"))
    blobs += entry.is_regular_file() ? 1 : 0;
  EXPECT_EQ(blobs, 0U);
}

}  // namespace
}  // namespace semblante::test
