// Every route of openapi.json answers as it says (test_client.h holds each answer against it); every limit and every
// bad input gets a problem document that names what is wrong.

#include <algorithm>
#include <atomic>
#include <csignal>
#include <fstream>
#include <future>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "protocol/hash/sha256.h"
#include "tests/integration/server/model_flow.h"
#include "tests/integration/server/shared_server.h"

namespace semblante::test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

/// One server for all tests of this file: each makes its own models.
class Routes : public SharedServer {
 protected:
  static void SetUpTestSuite() {
    start({"--demo", "--max-upload-bytes", "300000", "--voice-program",
           SEMBLANTE_SOURCE_DIR "/server/voice/examples/beeps.py"});
  }

  static void expect_advice(const Reply& reply, const std::string& advice) {
    EXPECT_EQ(json_of(reply).value("advice", ""), advice) << reply.body;
  }
  static void expect_problem(const Reply& reply, int status, const std::string& slug, const std::string& pointer = {}) {
    EXPECT_EQ(reply.status, status) << reply.body;
    EXPECT_EQ(reply.headers.contains("content-type") ? reply.headers.at("content-type") : "",
              "application/problem+json");
    const auto problem = json_of(reply);
    EXPECT_EQ(problem.value("type", ""), "/problems/" + slug) << reply.body;
    EXPECT_EQ(problem.value("status", 0), status);
    EXPECT_FALSE(problem.value("detail", "").empty());
    EXPECT_EQ(problem.value("pointer", ""), pointer) << reply.body;
    EXPECT_EQ(request(port(), "GET", problem.value("type", "/")).status, 200) << "the type can be looked up";
    EXPECT_EQ(request(port(), "GET", "/healthz").status, 200) << "the server goes on";
  }
};

void wait_for_frames(int port, const std::string& recording) {
  EXPECT_TRUE(testing::eventually([&] {
    return json_of(request(port, "GET", "/v1/recordings/" + recording))["frames"] > 0;
  })) << "nothing was recorded";
}

TEST_F(Routes, EveryRoute_AnswersAsDocumented) {
  const auto document = json_of(request(port(), "GET", "/openapi.json"));
  const auto model = import_grid(port());
  const auto job = parametrize_grid(port(), model);
  ASSERT_EQ(job.value("state", ""), "done") << job;
  // Another one keeps the artefacts of this package when the walk makes a new one, with other points.
  ASSERT_EQ(parametrize_grid(port(), import_grid(port())).value("state", ""), "done");
  // Proposals want more points than a mouth has.
  json enough = json::parse(grid_points());
  for (const char* const id : {"9.3", "9.15", "8.1", "8.2", "3.7", "3.12"})
    enough["points"][id] = {{"vertex", 10 + 7 * enough["points"].size()}};
  ASSERT_EQ(request(port(), "PUT", "/v1/models/" + model + "/feature-points", enough.dump(), json_type).status, 200);
  const auto package = json_of(request(port(), "GET", "/v1/models/" + model));
  const auto hash = package["package"]["artefacts"]["mesh.drc"]["sha256"].get<std::string>();
  const std::string by_hand = R"({"name":"Grin","displacements":{"2.4":[100,50,0]}})";
  const auto set = json_of(request(port(), "POST", "/v1/expressions", by_hand, json_type));
  std::map<std::string, std::string> good = {{"{model}", model}, {"{job}", job["id"]},    {"{stream}", "walk"},
                                             {"{sha256}", hash}, {"{slug}", "not-found"}, {"{expression}", set["id"]}};
  good["{token}"] = json_of(request(port(), "POST", "/v1/tokens", R"({"scope":"read"})", json_type))["token"]["id"];
  // A recording of another stream, with a frame in it.
  request(port(), "POST", "/v1/streams", R"({"name":"kept"})", json_type);
  good["{recording}"] = json_of(request(port(), "POST", "/v1/streams/kept/recordings"))["id"];
  request(port(), "POST", "/v1/streams/kept/frames", R"({"frames":[{"faps":{"3":80}}]})", json_type);
  request(port(), "POST", "/v1/recordings/" + good["{recording}"] + "/stop");
  const json short_speech = {{"text", "Mamma mia!"}, {"language", "en"}};
  good["{speech}"] = json_of(request(port(), "POST", "/v1/speeches", short_speech.dump(), json_type))["id"];
  // Long enough to be still speaking when the rest of the walk asks for it.
  const json long_speech = {{"text", std::string(2'000, 'a')}, {"language", "en"}, {"take_over", true}};
  struct Body {
    std::string text, type;
  };
  std::string short_fap = "2.1 short 25 1\n";
  for (int n = 0; n < 68; ++n) short_fap += n == 2 ? "1 " : "0 ";
  short_fap += "\n0 200\n";
  const std::map<std::string, Body> bodies = {
      {"post /v1/models", {grid_obj(5), "model/obj"}},
      {"post /v1/session", {R"({"token":"any"})", "application/json"}},
      {"post /v1/tickets", {R"({"path":"/v1/models"})", "application/json"}},
      {"post /v1/tokens", {R"({"scope":"read"})", "application/json"}},
      {"patch /v1/models/{model}", {R"({"name":"Renamed"})", "application/json"}},
      {"put /v1/models/{model}/feature-points", {grid_points(), "application/json"}},
      {"post /v1/models/{model}/clip",
       {R"({"format":"semblante.performance","version":1,"cues":[{"time":0,"duration":100,"viseme":"a"}]})",
        "application/json"}},
      {"post /v1/expressions", {by_hand, "application/json"}},
      {"put /v1/expressions/{expression}", {by_hand, "application/json"}},
      {"post /v1/speeches", {short_speech.dump(), "application/json"}},
      {"post /v1/streams/{stream}/speech", {long_speech.dump(), "application/json"}},
      {"post /v1/streams", {R"({"name":"walk","viseme_share":1})", "application/json"}},
      {"post /v1/streams/{stream}/frames", {R"({"frames":[{"faps":{"3":200}}]})", "application/json"}},
      {"post /v1/streams/{stream}/fap", {short_fap, "text/plain"}},
      {"post /v1/streams/{stream}/plays",
       {R"({"loop":true,"take_over":true,"recording":")" + good["{recording}"] + "\"}", "application/json"}},
      {"post /v1/streams/{stream}/performances",
       {R"({"format":"semblante.performance","version":1,"idle":{"seed":7}})", "application/json"}}};
  // Creating before reading, deleting last, and what is within a thing before the thing.
  std::vector<std::string> paths;
  for (const auto& [path, item] : document["paths"].items()) paths.push_back(path);
  for (const std::string method : {"post", "get", "put", "patch", "delete"}) {
    if (method == "delete") std::reverse(paths.begin(), paths.end());
    for (const auto& path : paths) {
      const auto& item = document["paths"][path];
      if (!item.contains(method)) continue;
      const auto fill = [&](const std::map<std::string, std::string>& values) {
        std::string target = path;
        for (const auto& [name, value] : values)
          if (const auto at = target.find(name); at != std::string::npos) target.replace(at, name.size(), value);
        return target;
      };
      auto upper = method;
      for (auto& c : upper) c = static_cast<char>(std::toupper(c));
      const auto found = bodies.find(method + " " + path);
      const Body body = found == bodies.end() ? Body{} : found->second;
      const Fields fields = body.type.empty() ? Fields{} : Fields{{"Content-Type", body.type}};
      const auto reply = request(port(), upper, fill(good), body.text, fields);
      SCOPED_TRACE(upper + " " + fill(good));
      // What plays publishes, and there is one publisher at a time.
      if (method + path == "post/v1/streams/{stream}/fap")
        request(port(), "DELETE", "/v1/streams/walk/performances/" + json_of(reply)["id"].get<std::string>());
      if (method + path == "post/v1/streams/{stream}/performances") good["{performance}"] = json_of(reply)["id"];
      // It takes over, and goes on until what follows has recorded it.
      if (method + path == "post/v1/streams/{stream}/plays") good["{performance}"] = json_of(reply)["id"];
      if (method + path == "post/v1/streams/{stream}/speech") good["{performance}"] = json_of(reply)["id"];
      if (method + path == "post/v1/streams/{stream}/recordings") wait_for_frames(port(), json_of(reply)["id"]);
      // A finished job cannot be cancelled any more; all else succeeds.
      if (upper + path != "DELETE/v1/jobs/{job}") {
        EXPECT_LT(reply.status, 300) << reply.body;
      }

      if (path.find('{') == std::string::npos) continue;
      const auto absent = request(port(), upper,
                                  fill({{"{model}", "absent"},
                                        {"{job}", "absent"},
                                        {"{stream}", "absent"},
                                        {"{performance}", "absent"},
                                        {"{recording}", "absent"},
                                        {"{speech}", "absent"},
                                        {"{expression}", "absent"},
                                        {"{sha256}", std::string(64, '0')},
                                        {"{slug}", "absent"}}),
                                  body.text, fields);
      expect_problem(absent, 404, "not-found");
    }
  }
}

TEST_F(Routes, Package_IsServedByTagRangeAndHash) {
  const auto model = import_grid(port());
  ASSERT_EQ(parametrize_grid(port(), model).value("state", ""), "done");
  for (const std::string name : {"mesh.drc", "weights", "rig.json", "face.glb", "report.json"}) {
    SCOPED_TRACE(name);
    const auto target = "/v1/models/" + model + "/" + name;
    const auto whole = request(port(), "GET", target);
    ASSERT_EQ(whole.status, 200);
    const auto tag = whole.headers.at("etag");
    EXPECT_EQ(request(port(), "GET", target, {}, {{"If-None-Match", tag}}).status, 304);
    EXPECT_EQ(request(port(), "GET", target, {}, {{"If-None-Match", "\"other\""}}).status, 200);
    const auto part = request(port(), "GET", target, {}, {{"Range", "bytes=2-5"}});
    EXPECT_EQ(part.status, 206);
    EXPECT_EQ(part.body, whole.body.substr(2, 4));
    EXPECT_EQ(part.headers.at("content-range"), "bytes 2-5/" + std::to_string(whole.body.size()));
    EXPECT_EQ(request(port(), "GET", target, {}, {{"Range", "bytes=-3"}}).body,
              whole.body.substr(whole.body.size() - 3));
    expect_problem(request(port(), "GET", target, {}, {{"Range", "bytes=99999999-"}}), 416, "range-not-satisfiable");
    const auto head = request(port(), "HEAD", target);
    EXPECT_EQ(head.status, 200);
    EXPECT_EQ(head.body, "");
    EXPECT_EQ(head.headers.at("content-length"), std::to_string(whole.body.size()));
    const auto by_hash = request(port(), "GET", "/v1/artefacts/" + tag.substr(8, 64));
    EXPECT_EQ(by_hash.body, whole.body);
    EXPECT_THAT(by_hash.headers.at("cache-control"), HasSubstr("immutable"));
  }
  EXPECT_EQ(request(port(), "GET", "/v1/models/" + model + "/preview.glb").body.substr(0, 4), "glTF");
}

TEST_F(Routes, Protocol_IsServedWithTheBytesOfItsFiles) {
  const auto file = [](const char* path) {
    std::ifstream stream(std::string(SEMBLANTE_SOURCE_DIR) + path, std::ios::binary);
    return std::string{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  };
  const auto specification = request(port(), "GET", "/v1/protocol/SPEC.md");
  EXPECT_EQ(specification.headers.at("content-type"), "text/markdown; charset=utf-8");
  EXPECT_EQ(specification.headers.at("cache-control"), "no-cache") << "another version may say more";
  EXPECT_EQ(specification.body, file("/protocol/SPEC.md"));

  const std::string target = "/v1/protocol/packed_tables.json";
  const auto tables = request(port(), "GET", target);
  ASSERT_EQ(tables.status, 200);
  EXPECT_EQ(tables.headers.at("content-type"), "application/json");
  EXPECT_EQ(tables.body, file("/protocol/schema/packed_tables.json"));
  EXPECT_THAT(tables.headers.at("cache-control"), HasSubstr("immutable"));
  EXPECT_EQ(request(port(), "GET", target, {}, {{"If-None-Match", tables.headers.at("etag")}}).status, 304);

  // The sentence of the specification that states length and hash, and where the file is.
  const std::string stated = "UTF-8 JSON, " + std::to_string(tables.body.size()) + " bytes, with the SHA-256 `" +
                             sha256_hex(tables.body) + "`";
  EXPECT_THAT(specification.body, HasSubstr(stated));
  EXPECT_THAT(specification.body, HasSubstr("`GET " + target + "`"));
}

TEST_F(Routes, Report_IsThereFromTheImportOn) {
  auto obj = grid_obj(9);
  obj += "v 0 0 50\n";  // used by no face
  const auto made =
      json_of(request(port(), "POST", "/v1/models?filename=grid.obj", obj, {{"Content-Type", "model/obj"}}));
  ASSERT_EQ(wait_for_job(port(), made["job"]["id"]).value("state", ""), "done");
  const std::string model = made["model"]["id"];
  const auto target = "/v1/models/" + model + "/report.json";
  const auto expect_report = [&] {
    const auto reply = request(port(), "GET", target);
    EXPECT_EQ(reply.headers.at("content-type"), "application/json");
    const auto report = json_of(reply);
    EXPECT_EQ(report["version"], 1);
    const auto found = std::find_if(report["findings"].begin(), report["findings"].end(),
                                    [](const json& finding) { return finding["code"] == "unused-vertices"; });
    EXPECT_NE(found, report["findings"].end()) << report;
    if (found == report["findings"].end()) return reply;
    EXPECT_EQ((*found)["severity"], "note");
    EXPECT_EQ((*found)["place"]["vertices"], json({{"sample", {81}}, {"count", 1}}));
    EXPECT_EQ((*found)["place"]["position"], json({0, 0, 50}));
    const auto represented = json_of(request(port(), "GET", "/v1/models/" + model));
    EXPECT_EQ(represented["findings"], report["summary"]);
    EXPECT_EQ(represented["links"]["report"], target);
    return reply;
  };
  expect_report();
  ASSERT_EQ(parametrize_grid(port(), model).value("state", ""), "done");
  expect_report();
}

TEST_F(Routes, JobEvents_EndWithDone) {
  const auto model = import_grid(port());
  request(port(), "PUT", "/v1/models/" + model + "/feature-points", grid_points(), json_type);
  // Who asks when the job has ended already hears of its end alone: then another one is made.
  EXPECT_TRUE(testing::eventually([&] {
    const auto job = json_of(request(port(), "POST", "/v1/models/" + model + "/parametrizations"));
    const auto events = request(port(), "GET", "/v1/jobs/" + job["id"].get<std::string>() + "/events");
    EXPECT_EQ(events.headers.at("content-type"), "text/event-stream");
    EXPECT_THAT(events.body, HasSubstr("event: done\n"));
    EXPECT_EQ(events.body.rfind("event: done"), events.body.rfind("event: ")) << "nothing comes after the end";
    return events.body.find("event: progress\n") != std::string::npos;
  })) << "no progress is told";
}

TEST_F(Routes, IdempotencyKey_MakesOneModel) {
  const Fields fields = {{"Content-Type", "model/obj"}, {"Idempotency-Key", "upload-1"}};
  const auto first = json_of(request(port(), "POST", "/v1/models?filename=a.obj", grid_obj(4), fields));
  const auto second = json_of(request(port(), "POST", "/v1/models?filename=a.obj", grid_obj(4), fields));
  EXPECT_EQ(first["model"]["id"], second["model"]["id"]);
  expect_problem(request(port(), "POST", "/v1/models?filename=a.obj", grid_obj(6), fields), 422,
                 "idempotency-key-reused");
}

TEST_F(Routes, Edits_HonourIfMatch) {
  const auto model = import_grid(port());
  const auto target = "/v1/models/" + model + "/feature-points";
  const auto tag = request(port(), "GET", target).headers.at("etag");
  const Fields with_tag = {{"Content-Type", "application/json"}, {"If-Match", tag}};
  EXPECT_EQ(request(port(), "PUT", target, grid_points(), with_tag).status, 200);
  expect_problem(request(port(), "PUT", target, grid_points(), with_tag), 412, "precondition-failed");
  expect_problem(request(port(), "PATCH", "/v1/models/" + model, R"({"name":"x"})", with_tag), 412,
                 "precondition-failed");
}

TEST_F(Routes, Frame_IsGuessed_AndCorrected) {
  const auto id = import_grid(port());
  const std::string path = "/v1/models/" + id;
  auto model = json_of(request(port(), "GET", path));
  EXPECT_EQ(model["frame"]["axes"], (json{{"up", "+Y"}, {"front", "+Z"}}));
  EXPECT_EQ(model["frame"]["guessed"], true);
  EXPECT_EQ(model["frame"]["sure"]["axes"], false) << "a sheet is no head";
  EXPECT_FALSE(model["frame"]["reasons"].empty());
  EXPECT_EQ(model["morph_targets"], json::array());

  const Fields patch = {{"Content-Type", "application/merge-patch+json"}};
  const auto unit = request(port(), "PATCH", path, R"({"frame":{"unit":"cm"}})", patch);
  EXPECT_EQ(unit.status, 200) << "a unit is a word: nothing is to be done";
  EXPECT_EQ(json_of(unit)["frame"]["unit"], "cm");
  EXPECT_EQ(json_of(unit)["frame"]["metres_per_unit"], 0.01);
  EXPECT_EQ(json_of(unit)["frame"]["by_user"], (json{{"unit", true}, {"axes", false}}));

  EXPECT_EQ(parametrize_grid(port(), id)["state"], "done");
  request(port(), "PUT", path + "/feature-points", R"({"points":{"2.1":{"vertex":4},"7.1":{"position":[1,2,3]}}})",
          {{"Content-Type", "application/json"}});
  auto turned = request(port(), "PATCH", path, R"({"frame":{"up":"+Z"}})", patch);
  ASSERT_EQ(turned.status, 202) << turned.body;
  EXPECT_EQ(json_of(turned)["state"], "importing");
  const auto location = turned.headers.at("location");
  EXPECT_EQ(wait_for_job(port(), location.substr(location.rfind('/') + 1))["state"], "done");
  model = json_of(request(port(), "GET", path));
  EXPECT_EQ(model["state"], "ready");
  EXPECT_TRUE(model["package"].is_null()) << "the old one stands the old way";
  EXPECT_EQ(model["frame"]["axes"], (json{{"up", "+Z"}, {"front", "-Y"}}));
  EXPECT_EQ(model["frame"]["guessed"], false);
  // The grid lay in x y, 0 to 8 in y: now it lies flat, 0 to -8 in z.
  EXPECT_EQ(model["bounds"]["min"], (json{-4.0, 0.0, -8.0}));
  const auto points = json_of(request(port(), "GET", path + "/feature-points"))["points"];
  EXPECT_EQ(points["2.1"]["vertex"], 4);
  EXPECT_EQ(points["7.1"]["position"], (json{1.0, 3.0, -2.0})) << "marked positions go where the model goes";
  const auto report = json_of(request(port(), "GET", path + "/report.json"));
  EXPECT_EQ(report["frame"], model["frame"]);

  turned = request(port(), "PATCH", path, R"({"frame":{"up":null}})", patch);
  ASSERT_EQ(turned.status, 202) << turned.body;
  const auto again = turned.headers.at("location");
  EXPECT_EQ(wait_for_job(port(), again.substr(again.rfind('/') + 1))["state"], "done");
  model = json_of(request(port(), "GET", path));
  EXPECT_EQ(model["bounds"]["max"], (json{4.0, 8.0, 0.0})) << "back to the guess";
  EXPECT_EQ(json_of(request(port(), "GET", path + "/feature-points"))["points"]["7.1"]["position"],
            (json{1.0, 2.0, 3.0}));
}

TEST_F(Routes, BadFrameWishes_NameTheField) {
  const auto id = import_grid(port());
  const auto pointer_of = [&](const std::string& body) {
    const auto reply = request(port(), "PATCH", "/v1/models/" + id, body, {{"Content-Type", "application/json"}});
    EXPECT_EQ(reply.status, 422) << body;
    return json_of(reply).value("pointer", "");
  };
  EXPECT_EQ(pointer_of(R"({"frame":7})"), "/frame");
  EXPECT_EQ(pointer_of(R"({"frame":{"unit":"km"}})"), "/frame/unit");
  EXPECT_EQ(pointer_of(R"({"frame":{"up":"Q"}})"), "/frame/up");
  EXPECT_EQ(pointer_of(R"({"frame":{"front":5}})"), "/frame/front");
  EXPECT_EQ(pointer_of(R"({"frame":{"up":"+Y","front":"-Y"}})"), "/frame/front");
  EXPECT_EQ(pointer_of(R"({"frame":{"axes":{}}})"), "/frame/axes");
}

TEST_F(Routes, FeaturePoints_FillByMirror) {
  const auto model = import_grid(port());
  // Vertex 38 is column 2 of row 4, x = -2; its mirror is column 6: vertex 42.
  const auto reply = json_of(request(port(), "PUT", "/v1/models/" + model + "/feature-points?fill=mirror",
                                     R"({"points":{"2.4":{"vertex":38}}})", json_type));
  EXPECT_EQ(reply["points"]["2.5"]["vertex"], 42);
  EXPECT_EQ(reply["points"]["2.5"]["position"], (json{2.0, 4.0, 0.0}));
}

TEST_F(Routes, Multipart_TakesFileAndName) {
  const std::string body =
      "--XX\r\nContent-Disposition: form-data; name=\"name\"\r\n\r\nFrom a form\r\n--XX\r\n"
      "Content-Disposition: form-data; name=\"file\"; filename=\"grid.obj\"\r\n\r\n" +
      grid_obj(4) + "\r\n--XX--\r\n";
  const auto made =
      json_of(request(port(), "POST", "/v1/models", body, {{"Content-Type", "multipart/form-data; boundary=XX"}}));
  EXPECT_EQ(made["model"]["name"], "From a form");
  EXPECT_EQ(wait_for_job(port(), made["job"]["id"])["state"], "done");
}

TEST_F(Routes, PagesOfModels_FollowNext) {
  import_grid(port(), 4);
  import_grid(port(), 4);
  auto page = json_of(request(port(), "GET", "/v1/models?limit=1"));
  std::size_t count = 0;
  while (true) {
    count += page["models"].size();
    if (page["next"].is_null()) break;
    page = json_of(request(port(), "GET", "/v1/models?limit=1&after=" + page["next"].get<std::string>()));
  }
  EXPECT_EQ(count, json_of(request(port(), "GET", "/v1/models?limit=200"))["models"].size());
}

TEST_F(Routes, PageOfModels_IsSentAgain_OnlyIfItChanged) {
  import_grid(port(), 4);
  const auto page = request(port(), "GET", "/v1/models?limit=200");
  const auto ask = [&] {
    return request(port(), "GET", "/v1/models?limit=200", {}, {{"If-None-Match", page.headers.at("etag")}});
  };
  EXPECT_EQ(ask().status, 304);
  EXPECT_EQ(ask().body, "");
  import_grid(port(), 4);
  EXPECT_EQ(ask().status, 200);
}

/// What a request has found is sent, or what has replaced it since; never that the file is gone.
TEST_F(Routes, ArtefactThatJobsReplace_IsAnsweredAtAnyTime) {
  const std::string model = "/v1/models/" + import_grid(port());
  request(port(), "PUT", model + "/feature-points", grid_points(), json_type);
  const auto parametrize = [&](const std::string& weights) {
    const auto job =
        json_of(request(port(), "POST", model + "/parametrizations", R"({"weights":")" + weights + "\"}", json_type));
    EXPECT_EQ(wait_for_job(port(), job.value("id", "")).value("state", ""), "done") << job;
  };
  parametrize("paper");
  std::atomic<bool> over = false;
  std::vector<std::future<std::string>> clients;
  for (const char* const name : {"/weights", "/rig.json", "/weights", "/mesh.drc"})
    clients.push_back(std::async(std::launch::async, [&, name] {
      std::string faults;
      while (!over) {
        const auto reply = request(port(), "GET", model + name);
        if (reply.status != 200 || reply.headers.at("etag") != "\"sha256-" + sha256_hex(reply.body) + "\"")
          faults.append(name).append(" ").append(std::to_string(reply.status)).append("\n");
      }
      return faults;
    }));
  for (int round = 0; round < 30; ++round) parametrize(round % 2 == 0 ? "smooth" : "paper");
  over = true;
  for (auto& client : clients) EXPECT_EQ(client.get(), "");
}

TEST_F(Routes, RangeOfADocument_IsIgnored) {
  const std::string model = "/v1/models/" + import_grid(port(), 4);
  for (const auto& target : {std::string("/openapi.json"), std::string("/v1/protocol/SPEC.md"), model,
                             model + "/feature-points", std::string("/v1/expressions/joy")}) {
    const auto answer = request(port(), "GET", target, {}, {{"Range", "bytes=2-5"}});
    EXPECT_EQ(answer.status, 200) << target;
    EXPECT_EQ(answer.headers.count("accept-ranges"), 0U) << target;
  }
}

TEST_F(Routes, BadRequests_NameTheField) {
  const auto model = import_grid(port());
  const auto points = "/v1/models/" + model + "/feature-points";
  const auto put = [&](const std::string& text) { return request(port(), "PUT", points, text, json_type); };
  expect_problem(put(R"({"points":{"2.1":{"vertex":81}}})"), 422, "invalid-feature-point", "/points/2.1/vertex");
  expect_problem(put(R"({"points":{"2.1":{"vertex":-1}}})"), 422, "invalid-feature-point", "/points/2.1/vertex");
  expect_problem(put(R"({"points":{"2.1":{"vertex":1.5}}})"), 422, "invalid-feature-point", "/points/2.1/vertex");
  expect_problem(put(R"({"points":{"2.1":{"vertex":"four"}}})"), 422, "invalid-feature-point", "/points/2.1/vertex");
  expect_problem(put(R"({"points":{"2.1":{"vertex":null}}})"), 422, "invalid-feature-point", "/points/2.1");
  expect_problem(put(R"({"points":{"2.1":{"position":[0,1]}}})"), 422, "invalid-feature-point", "/points/2.1/position");
  expect_problem(put(R"({"points":{"2.1":{"position":[0,1,"x"]}}})"), 422, "invalid-feature-point",
                 "/points/2.1/position/2");
  expect_problem(put(R"({"points":{"99.1":{"vertex":1}}})"), 422, "invalid-feature-point", "/points/99.1");
  expect_problem(put(R"({"points":[]})"), 422, "invalid-field", "/points");
  expect_problem(put(R"({})"), 422, "invalid-field", "/points");
  expect_problem(put("{\"points\":"), 400, "malformed-request");
  expect_problem(put(R"({"points": {"2.1": {"vertex": 1}, "2.1": {"vertex": 2}}})"), 400, "malformed-request",
                 "/points/2.1");
  std::string deepest = "/points";
  for (int i = 0; i < 63; ++i) deepest += "/0";
  expect_problem(put("{\"points\":" + std::string(100'000, '[')), 400, "malformed-request", deepest);
  expect_problem(put("[1]"), 422, "invalid-field");
  expect_problem(request(port(), "PUT", points, grid_points(), {{"Content-Type", "text/plain"}}), 415,
                 "unsupported-media-type");
  expect_problem(request(port(), "POST", "/v1/models/" + model + "/parametrizations"), 422, "missing-feature-points",
                 "/points");
  expect_problem(
      request(port(), "POST", "/v1/models/" + model + "/parametrizations", R"({"metric":"crow"})", json_type), 422,
      "invalid-field", "/metric");
  expect_problem(
      request(port(), "POST", "/v1/models/" + model + "/parametrizations", R"({"weight_bits":20})", json_type), 422,
      "invalid-field", "/weight_bits");
  for (const char* const wrong : {"0.2", "4.1", "-1", "1e300", "\"2\"", "null"}) {
    expect_problem(request(port(), "POST", "/v1/models/" + model + "/parametrizations",
                           std::string(R"({"articulation":)") + wrong + "}", json_type),
                   422, "invalid-field", "/articulation");
  }
  const auto patch = [&](const std::string& text) {
    return request(port(), "PATCH", "/v1/models/" + model, text, json_type);
  };
  expect_problem(patch(R"({"roles":{"0":"elbow"}})"), 422, "invalid-field", "/roles/0");
  expect_problem(patch(R"({"roles":{"7":"skin"}})"), 422, "invalid-field", "/roles/7");
  expect_problem(patch(R"({"name":""})"), 422, "invalid-field", "/name");
  expect_problem(patch(R"({"colour":"red"})"), 422, "invalid-field", "/colour");
  expect_problem(request(port(), "GET", "/v1/models?limit=0"), 400, "invalid-argument", "?limit");
  expect_problem(request(port(), "GET", "/v1/models?after=nobody"), 400, "invalid-argument", "?after");
}

TEST_F(Routes, OtherMethodsOfAPage_AreToldApartFromPagesThatAreMissing) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder.path() / "web");
  std::ofstream(folder.path() / "web" / "index.html") << "the page";
  const ServerProcess pages(folder.path() / "data", {"--web-root", (folder.path() / "web").string()});
  for (const char* method : {"TRACE", "POST", "DELETE"}) {
    const auto wrong = request(pages.port(), method, "/");
    expect_problem(wrong, 405, "method-not-allowed");
    EXPECT_EQ(wrong.headers.at("allow"), "OPTIONS, GET, HEAD") << method;
    expect_problem(request(pages.port(), method, "/missing.html"), 404, "not-found");
  }
  const auto options = request(pages.port(), "OPTIONS", "/");
  EXPECT_EQ(options.status, 204);
  EXPECT_EQ(options.headers.at("allow"), "OPTIONS, GET, HEAD");
  EXPECT_EQ(request(pages.port(), "GET", "/").body, "the page");
}

TEST_F(Routes, BadRoutesAndMethods_AreToldApart) {
  expect_problem(request(port(), "GET", "/v1/nothing"), 404, "not-found");
  expect_problem(request(port(), "GET", "/v1/models/a/b/c"), 404, "not-found");
  const auto wrong = request(port(), "PUT", "/v1/models", "{}");
  expect_problem(wrong, 405, "method-not-allowed");
  EXPECT_EQ(wrong.headers.at("allow"), "OPTIONS, GET, HEAD, POST");
  expect_problem(request(port(), "GET", "/v1/models", {}, {{"Accept", "image/png"}}), 406, "not-acceptable");
  EXPECT_EQ(request(port(), "GET", "/v1/models", {}, {{"Accept", "image/png, */*;q=0.1"}}).status, 200);
  const auto own = "http://127.0.0.1";
  const auto unreadable = request(port(), "GET", "/v1/streams/..%2Fdemo", {}, {{"Origin", own}});
  EXPECT_EQ(unreadable.status, 400);
  EXPECT_EQ(unreadable.headers.at("access-control-allow-origin"), own) << "a page is told what is wrong";
  const auto preflight = request(port(), "OPTIONS", "/v1/models", {}, {{"Origin", own}});
  EXPECT_EQ(preflight.status, 204);
  EXPECT_EQ(preflight.headers.at("access-control-allow-origin"), own);
  const auto whole_server = request(port(), "OPTIONS", "*");
  EXPECT_EQ(whole_server.status, 204);
  EXPECT_THAT(whole_server.headers.at("allow"), HasSubstr("DELETE"));
  expect_problem(request(port(), "GET", "*"), 400, "malformed-request");
  expect_problem(request(port(), "POST", "/v1/streams", "{}", {{"Origin", "https://evil.example"}}), 403,
                 "forbidden-origin");
}

TEST_F(Routes, EveryAnswer_BringsItsPoliciesForBrowsers) {
  for (const auto* target : {"/version", "/v1/models", "/v1/models/none", "/absent.html"}) {
    SCOPED_TRACE(target);
    const auto reply = request(port(), "GET", target);
    EXPECT_THAT(reply.headers.at("content-security-policy"), HasSubstr("frame-ancestors 'none'"));
    EXPECT_EQ(reply.headers.at("x-frame-options"), "DENY");
    EXPECT_EQ(reply.headers.at("x-content-type-options"), "nosniff");
    EXPECT_EQ(reply.headers.at("referrer-policy"), "no-referrer");
  }
}

TEST_F(Routes, RequestsToAForeignName_AreRefused) {
  for (const auto* head :
       {"GET /v1/models", "GET /", "OPTIONS /v1/models", "DELETE /v1/streams/demo", "GET /v1/streams/demo"}) {
    const auto reply = parse_reply(
        raw_exchange(port(), std::string(head) + " HTTP/1.1\r\nHost: rebound.example:80\r\nConnection: close\r\n\r\n"));
    SCOPED_TRACE(head);
    expect_problem(reply, 421, "foreign-host");
  }
  const auto socket = parse_reply(raw_exchange(
      port(),
      "GET /v1/streams/demo HTTP/1.1\r\nHost: rebound.example\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
      "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\n\r\n"));
  expect_problem(socket, 421, "foreign-host");
}

TEST_F(Routes, TargetsInAbsoluteForm_AreServed_AndTheirHostCounts) {
  const auto get = [&](const std::string& target, const std::string& host) {
    return parse_reply(
        raw_exchange(port(), "GET " + target + " HTTP/1.1\r\nHost: " + host + "\r\nConnection: close\r\n\r\n"));
  };
  EXPECT_EQ(get("http://localhost:1/version", "localhost").status, 200);
  EXPECT_EQ(get("http://localhost/version", "rebound.example").status, 200);
  expect_problem(get("http://rebound.example/version", "localhost"), 421, "foreign-host");
  expect_problem(get("http://localhost@rebound.example/version", "localhost"), 421, "foreign-host");
  expect_problem(get("http:///version", "localhost"), 400, "malformed-request");
}

TEST_F(Routes, Uploads_OverTheLimitOrNoModel_AreRefused) {
  const Fields type = {{"Content-Type", "application/octet-stream"}};
  expect_problem(request(port(), "POST", "/v1/models", std::string(300'001, 'x'), type), 413, "content-too-large");
  expect_problem(request(port(), "POST", "/v1/models", std::string(1000, '\x01'), type), 415, "unsupported-media-type",
                 "/file");
  expect_problem(request(port(), "POST", "/v1/models", "x", {{"Content-Type", "application/json"}}), 415,
                 "unsupported-media-type");
  expect_problem(request(port(), "POST", "/v1/models", {}, type), 411, "length-required");
  expect_problem(request(port(), "POST", "/v1/models", "x", {{"Content-Type", "multipart/form-data; boundary=Q"}}), 400,
                 "malformed-request");
  // Announced in a chunk, not in the header.
  const auto chunked = parse_reply(raw_exchange(
      port(), "POST /v1/models HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\n\r\n493e1\r\n" +
                  std::string(300'001, 'x') + "\r\n0\r\n\r\n"));
  expect_problem(chunked, 413, "content-too-large");
  // The size of a chunk alone: what it announces is not waited for. The second is too large with the first.
  for (const std::string& begin : {std::string("493e1\r\n"), "1000\r\n" + std::string(0x1000, 'x') + "\r\n48400\r\n"}) {
    const auto announced = parse_reply(raw_exchange(
        port(), "POST /v1/models HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\n\r\n" + begin));
    expect_problem(announced, 413, "content-too-large");
    expect_advice(announced, "reduce-model");
  }
}

TEST_F(Routes, RefusedFiles_HaveWhatHelps) {
  const Fields type = {{"Content-Type", "application/octet-stream"}};
  const auto upload = [&](const std::string& bytes) { return request(port(), "POST", "/v1/models", bytes, type); };
  expect_advice(upload("Kaydara FBX Binary  "), "export-as-glb");
  expect_advice(upload(std::string(1000, '\x01')), "export-as-glb");
  expect_advice(upload("Rar!\x1A\x07"), "unpack");
  expect_advice(upload("\x89PNG\r\n"), "choose-model");
  expect_advice(upload("<!DOCTYPE html>"), "download-model");
  expect_advice(upload(std::string(300'001, 'x')), "reduce-model");
  const std::string part = "--Q\r\nContent-Disposition: form-data; name=\"file\"\r\n\r\nv 0 0 0\r\n";
  const Fields form = {{"Content-Type", "multipart/form-data; boundary=Q"}};
  expect_advice(request(port(), "POST", "/v1/models", part + part + "--Q--\r\n", form), "send-all-files");
  const auto model = import_grid(port());
  const std::string expression = "--Q\r\nContent-Disposition: form-data; name=\"options\"\r\n\r\n{\"model\":\"" +
                                 model +
                                 "\"}\r\n--Q\r\nContent-Disposition: form-data; name=\"expression\"; "
                                 "filename=\"a.7z\"\r\n\r\n7z\xBC\xAF\x27\x1C\r\n--Q--\r\n";
  expect_advice(request(port(), "POST", "/v1/expressions", expression, form), "unpack");
  expect_advice(request(port(), "PUT", "/v1/models/" + model + "/feature-points",
                        R"({"points":{"2.1":{"vertex":99999}}})", json_type),
                "move-points");
  expect_advice(request(port(), "POST", "/v1/models/" + model + "/parametrizations", "{}", json_type), "mark-points");
  // Nothing is known that helps: other bodies than models, and what detail tells.
  expect_advice(request(port(), "POST", "/v1/models", "x", {{"Content-Type", "application/json"}}), "");
  expect_advice(request(port(), "POST", "/v1/streams", std::string(2'000'000, ' '), json_type), "");
  expect_advice(request(port(), "GET", "/v1/nothing"), "");
}

TEST_F(Routes, BrokenModels_FailTheirImportWithTheReason) {
  struct Case {
    std::string name, file, bytes;
  };
  std::string huge_glb("glTF\x02\x00\x00\x00\x00\x00\x00\x80\x10\x00\x00\x00JSON", 20);
  const std::vector<Case> cases = {{"cut short", "cut.glb", std::string("glTF\x02\x00\x00\x00\xff\x00\x00\x00", 12)},
                                   {"two gigabytes announced", "huge.glb", huge_glb + std::string(1000, ' ')},
                                   {"index out of range", "far.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n"},
                                   {"not a number", "nan.obj", "v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"},
                                   {"no triangles", "points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n"},
                                   {"many vertices announced", "many.ply",
                                    "ply\nformat ascii 1.0\nelement vertex 4000000000\nproperty float x\nproperty "
                                    "float y\nproperty float z\nend_header\n"},
                                   {"not what it says", "text.glb", "this is no model"}};
  for (const auto& item : cases) {
    SCOPED_TRACE(item.name);
    const auto reply = request(port(), "POST", "/v1/models?filename=" + item.file, item.bytes,
                               {{"Content-Type", "application/octet-stream"}});
    if (reply.status == 415) {
      expect_problem(reply, 415, "unsupported-media-type", "/file");
      continue;
    }
    ASSERT_EQ(reply.status, 202) << reply.body;
    const auto made = json_of(reply);
    const auto job = wait_for_job(port(), made["job"]["id"]);
    EXPECT_EQ(job["state"], "failed");
    EXPECT_FALSE(job["problem"].value("detail", "").empty());
    EXPECT_THAT(job["problem"].value("type", ""), HasSubstr("model"));
    const auto model = json_of(request(port(), "GET", "/v1/models/" + made["model"]["id"].get<std::string>()));
    EXPECT_EQ(model["state"], "failed");
    EXPECT_EQ(model["problem"], job["problem"]);
    expect_problem(request(port(), "PUT", "/v1/models/" + model["id"].get<std::string>() + "/feature-points",
                           grid_points(), json_type),
                   409, "conflict");
  }
}

TEST_F(Routes, BadFrames_NameTheField) {
  request(port(), "POST", "/v1/streams", R"({"name":"bad-frames"})", json_type);
  const auto post = [&](const std::string& text) {
    return request(port(), "POST", "/v1/streams/bad-frames/frames", text, json_type);
  };
  expect_problem(post(R"({"frames":[{"faps":{"99":1}}]})"), 422, "invalid-frame", "/frames/0/faps/99");
  expect_problem(post(R"({"frames":[{"viseme":{"select1":15}}]})"), 422, "invalid-frame", "/frames/0/viseme/select1");
  expect_problem(post(R"({"frames":[{"faps":{"3":"wide"}}]})"), 422, "invalid-frame", "/frames/0/faps/3");
  EXPECT_EQ(post("{\"frames\":").status, 400);
  EXPECT_EQ(post(R"({"frames":[]})").status, 422);
  EXPECT_EQ(json_of(request(port(), "GET", "/v1/streams/bad-frames"))["sequence"], 0);
  EXPECT_EQ(json_of(post(R"({"frames":[{"faps":{"3":200}}]})"))["sequence"], 1);
  expect_problem(request(port(), "POST", "/v1/streams", R"({"name":"bad-frames"})", json_type), 409, "conflict",
                 "/name");
  expect_problem(request(port(), "POST", "/v1/streams", R"({"name":"No Spaces"})", json_type), 422, "invalid-field",
                 "/name");
  expect_problem(request(port(), "POST", "/v1/streams", R"({"model":"nobody"})", json_type), 422, "invalid-field",
                 "/model");
  for (const std::string share : {"-0.01", "1.01", "\"half\"", "true", "[0.5]"}) {
    expect_problem(request(port(), "POST", "/v1/streams", R"({"viseme_share":)" + share + "}", json_type), 422,
                   "invalid-field", "/viseme_share");
  }
  for (const std::string interval : {"-1", "1001", "0.5", "null", "\"100\""})
    expect_problem(request(port(), "POST", "/v1/streams", R"({"batch_interval":)" + interval + "}", json_type), 422,
                   "invalid-field", "/batch_interval");
  expect_problem(request(port(), "DELETE", "/v1/streams/demo"), 409, "conflict");
}

TEST_F(Routes, RawGarbage_IsAnsweredOrDropped) {
  EXPECT_THAT(raw_exchange(port(), "\x16\x03\x01 no http here\r\n\r\n"), HasSubstr("400 Bad Request"));
  EXPECT_THAT(raw_exchange(port(), "GET /healthz HTTP/1.1\r\nX: " + std::string(20'000, 'y') + "\r\n\r\n"),
              HasSubstr("431 "));
  EXPECT_THAT(raw_exchange(port(), "GET /%zz HTTP/1.1\r\nHost: localhost\r\n\r\n"), HasSubstr("400 "));
  EXPECT_THAT(raw_exchange(port(), "GET /../../etc/passwd HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n"),
              HasSubstr("404 "));
  raw_exchange(port(), std::string(65536, '\xff'));
  EXPECT_EQ(request(port(), "GET", "/healthz").status, 200);
}

}  // namespace
}  // namespace semblante::test
