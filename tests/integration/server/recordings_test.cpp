// Streams are recorded, fetched in every format, looked into, and played again to identical frames.

#include <fstream>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/integration/server/model_flow.h"
#include "tests/integration/server/shared_server.h"

namespace semblante::test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

class Recordings : public SharedServer {
 protected:
  static void SetUpTestSuite() { start({"--max-recordings", "60"}); }
  static Reply get(const std::string& target) { return request(port(), "GET", target); }
  static Reply post(const std::string& target, const json& body = json::object()) {
    return request(port(), "POST", target, body.dump(), json_type);
  }
  /// A new stream.
  static std::string stream() {
    const auto made = post("/v1/streams");
    EXPECT_EQ(made.status, 201);
    return json_of(made)["id"];
  }
  static std::string record(const std::string& stream, const json& body = json::object()) {
    const auto made = post("/v1/streams/" + stream + "/recordings", body);
    EXPECT_EQ(made.status, 201) << made.body;
    EXPECT_EQ(made.headers.at("location"), "/v1/recordings/" + json_of(made)["id"].get<std::string>());
    return json_of(made)["id"];
  }
  /// Frames at irregular times, some together; the bodies of requests.
  static json irregular_frames() {
    json frames = json::array();
    const std::vector<int> times = {0, 7, 7, 31, 90, 133, 134, 200, 260, 261, 262, 300};
    for (std::size_t i = 0; i < times.size(); ++i) {
      json frame = {{"time", times[i]}, {"faps", {{"3", 8 * (i + 1)}, {"19", i % 2 == 0 ? 128 : 0}}}};
      if (i % 3 == 0) frame["viseme"] = {{"select1", 1 + i % 5}, {"select2", 0}, {"blend", 63}};
      frames.push_back(frame);
    }
    return frames;
  }
  /// A stopped recording of irregular_frames().
  static std::string recorded() {
    const auto id = stream();
    const auto recording = record(id, {{"name", "Irregular"}});
    EXPECT_EQ(post("/v1/streams/" + id + "/frames", {{"frames", irregular_frames()}}).status, 202);
    const auto stopped = json_of(post("/v1/recordings/" + recording + "/stop"));
    EXPECT_EQ(stopped["state"], "finished");
    EXPECT_EQ(stopped["frames"], 12);
    return recording;
  }
  static json frames_of(const std::string& recording) {
    auto frames = json_of(get("/v1/recordings/" + recording + "/frames"))["frames"];
    for (auto& frame : frames) {
      frame.erase("sequence");
      frame.erase("media_time");
    }
    return frames;
  }
  static void wait_until(const std::string& recording, const std::string& state) {
    EXPECT_TRUE(testing::eventually([&] { return json_of(get("/v1/recordings/" + recording))["state"] == state; }))
        << "not " << state;
  }
};

TEST_F(Recordings, Facts_AreSaid) {
  const auto id = stream();
  const auto recording = record(id, {{"name", "A take"}, {"max_duration", 600000}});
  auto now = json_of(get("/v1/recordings/" + recording));
  EXPECT_EQ(now["state"], "recording");
  EXPECT_EQ(now["name"], "A take");
  EXPECT_EQ(now["stream"], id);
  EXPECT_EQ(now["max_duration"], 600000);
  EXPECT_TRUE(now["durable_until"].is_null());
  EXPECT_TRUE(now["ended"].is_null());
  post("/v1/streams/" + id + "/frames", {{"frames", irregular_frames()}});
  testing::eventually([&] {
    now = json_of(get("/v1/recordings/" + recording));
    return now["durable_until"] == 300;
  });
  EXPECT_EQ(now["durable_until"], 300);
  EXPECT_EQ(now["frames"], 12);
  EXPECT_EQ(json_of(get("/v1/recordings/" + recording + "/frames?at=299"))["frames"][0]["time"], 262)
      << "while it runs";
  now = json_of(post("/v1/recordings/" + recording + "/stop"));
  EXPECT_EQ(now["ended"], "stopped");
  EXPECT_EQ(now["duration"], 300);
  EXPECT_TRUE(now["links"]["stop"].is_null());
  EXPECT_EQ(json_of(post("/v1/recordings/" + recording + "/stop")), now) << "it stays as it is";
}

TEST_F(Recordings, OutliveTheirStream_AndEndWithIt) {
  const auto id = stream();
  const auto first = record(id);
  const auto second = record(id);
  post("/v1/streams/" + id + "/frames", {{"frames", irregular_frames()}});
  EXPECT_EQ(request(port(), "DELETE", "/v1/streams/" + id).status, 204);
  wait_until(first, "finished");
  EXPECT_EQ(json_of(get("/v1/recordings/" + first))["ended"], "stream-ended");
  wait_until(second, "finished");
  const auto list = json_of(get("/v1/streams/" + id + "/recordings?limit=1"));
  ASSERT_EQ(list["recordings"].size(), 1U);
  EXPECT_EQ(list["recordings"][0]["id"], first);
  EXPECT_EQ(list["next"], first);
  EXPECT_EQ(json_of(get("/v1/streams/" + id + "/recordings?after=" + first))["recordings"][0]["id"], second);
  const auto newest = get("/v1/streams/" + id + "/recording?format=frames-json");
  EXPECT_EQ(newest.headers.at("content-location"), "/v1/recordings/" + second + "/content");
  EXPECT_EQ(request(port(), "DELETE", "/v1/recordings/" + second).status, 204);
  EXPECT_EQ(get("/v1/recordings/" + second).status, 404);
  EXPECT_EQ(frames_of(first).size(), 12U);
}

TEST_F(Recordings, Seek_GivesTheFrameThatHolds) {
  const auto recording = recorded();
  const auto at = [&](int ms) {
    return json_of(get("/v1/recordings/" + recording + "/frames?at=" + std::to_string(ms)))["frames"][0];
  };
  EXPECT_EQ(at(0)["faps"]["3"], 8);
  EXPECT_EQ(at(6)["faps"]["3"], 8);
  EXPECT_EQ(at(7)["faps"]["3"], 24) << "of two at one time the last";
  EXPECT_EQ(at(132)["time"], 90);
  EXPECT_EQ(at(99999)["faps"]["3"], 96);
  const auto part = json_of(get("/v1/recordings/" + recording + "/frames?from=8&to=133"))["frames"];
  ASSERT_EQ(part.size(), 3U);
  EXPECT_EQ(part[0]["time"], 31);
  EXPECT_EQ(part[2]["time"], 133);
  // Page by page, each frame once, also where two have one time.
  std::string next = "/v1/recordings/" + recording + "/frames?limit=2";
  std::vector<int> jaw;
  while (!next.empty()) {
    const auto page = json_of(get(next));
    for (const auto& frame : page["frames"]) jaw.push_back(frame["faps"]["3"]);
    next = page["next"].is_null() ? "" : page["next"].get<std::string>();
  }
  EXPECT_THAT(jaw, ::testing::ElementsAre(8, 16, 24, 32, 40, 48, 56, 64, 72, 80, 88, 96));
}

TEST_F(Recordings, PlayedAgain_AreTheSameFrames) {
  const auto recording = recorded();
  const auto other = stream();
  const auto again = record(other);
  const auto playing = post("/v1/streams/" + other + "/plays", {{"recording", recording}});
  ASSERT_EQ(playing.status, 202) << playing.body;
  EXPECT_EQ(json_of(playing)["kind"], "recording");
  EXPECT_EQ(json_of(playing)["name"], "Irregular");
  EXPECT_TRUE(testing::eventually([&] { return json_of(get("/v1/streams/" + other))["playing"].is_null(); }));
  EXPECT_EQ(json_of(post("/v1/recordings/" + again + "/stop"))["frames"], 12);
  EXPECT_EQ(frames_of(again), frames_of(recording));
}

TEST_F(Recordings, EveryFormat_IsFetched_AndPlayedOrReadAgain) {
  const auto recording = recorded();
  const auto content = [&](const std::string& query) {
    return get("/v1/recordings/" + recording + "/content?" + query);
  };
  const auto other = stream();
  const auto play = [&](const std::string& route, const Reply& body, const std::string& type) {
    const auto reply = request(port(), "POST", "/v1/streams/" + other + "/" + route + "?take_over=true", body.body,
                               {{"Content-Type", type}});
    EXPECT_EQ(reply.status, 202) << reply.body;
  };
  const auto performance = content("format=performance");
  EXPECT_EQ(performance.headers.at("content-type"), "application/json");
  EXPECT_EQ(json_of(performance)["format"], "semblante.performance");
  EXPECT_EQ(content("").body, performance.body) << "it is the default";
  play("performances", performance, "application/json");

  const auto fap = content("format=fap&rate=50");
  EXPECT_EQ(fap.headers.at("content-type"), "text/plain");
  EXPECT_THAT(fap.body, ::testing::StartsWith("2.1 " + recording + " 50 16\n"));
  play("fap", fap, "text/plain");

  const auto frames = content("format=frames-json");
  EXPECT_EQ(json_of(frames)["frames"], frames_of(recording));
  EXPECT_EQ(json_of(content("format=frames-json&from=100&to=200"))["frames"].size(), 4U) << "and the one that holds";
  const auto sampled = json_of(content("format=frames-json&rate=100"))["frames"];
  ASSERT_EQ(sampled.size(), 31U);
  EXPECT_EQ(sampled[30]["faps"]["3"], 96);

  const auto csv = content("format=arkit-csv");
  EXPECT_EQ(csv.headers.at("content-type"), "text/csv");
  EXPECT_THAT(csv.body, ::testing::StartsWith("Timecode,BlendShapeCount,EyeBlinkLeft,"));
  EXPECT_EQ(std::count(csv.body.begin(), csv.body.end(), '\n'), 13);

  const auto file = content("format=recording");
  EXPECT_EQ(file.body.substr(0, 7), "SEMBREC");
  const auto part =
      request(port(), "GET", "/v1/recordings/" + recording + "/content?format=recording", {}, {{"Range", "bytes=0-6"}});
  EXPECT_EQ(part.status, 206);
  EXPECT_EQ(part.body, "SEMBREC");
}

TEST_F(Recordings, Clip_IsMadeOnAModel) {
  const auto recording = recorded();
  const auto target = "/v1/recordings/" + recording + "/content?format=glb";
  EXPECT_EQ(get(target).status, 409) << "its stream had no model";
  EXPECT_EQ(get(target + "&model=absent").status, 404);
  const auto model = import_grid(port());
  const auto unready = get(target + "&model=" + model);
  EXPECT_EQ(unready.status, 409);
  EXPECT_THAT(unready.body, HasSubstr("not parametrized"));
  ASSERT_EQ(parametrize_grid(port(), model).value("state", ""), "done");
  const auto clip = get(target + "&model=" + model);
  ASSERT_EQ(clip.status, 200) << clip.body;
  EXPECT_EQ(clip.headers.at("content-type"), "model/gltf-binary");
  EXPECT_EQ(clip.body.substr(0, 4), "glTF");
  EXPECT_THAT(clip.body, HasSubstr("animations"));
}

TEST_F(Recordings, BadInput_IsNamed) {
  const auto expect = [](const Reply& reply, int status, const std::string& pointer) {
    EXPECT_EQ(reply.status, status) << reply.body;
    EXPECT_EQ(json_of(reply).value("pointer", ""), pointer) << reply.body;
  };
  const auto id = stream();
  const auto recording = recorded();
  expect(post("/v1/streams/" + id + "/recordings", {{"name", ""}}), 422, "/name");
  expect(post("/v1/streams/" + id + "/recordings", {{"max_duration", 0}}), 422, "/max_duration");
  expect(post("/v1/streams/" + id + "/recordings", {{"colour", "red"}}), 422, "/colour");
  expect(post("/v1/streams/" + id + "/plays"), 422, "/recording");
  expect(post("/v1/streams/" + id + "/plays", {{"recording", "absent"}}), 422, "/recording");
  expect(post("/v1/streams/" + id + "/plays", {{"recording", recording}, {"from", 301}}), 422, "/from");
  expect(post("/v1/streams/" + id + "/plays", {{"recording", recording}, {"loop", 1}}), 422, "/loop");
  const auto content = "/v1/recordings/" + recording + "/content?";
  expect(get(content + "format=mp4"), 400, "?format");
  expect(get(content + "from=5&to=4"), 400, "?to");
  expect(get(content + "from=-5"), 400, "?from");
  expect(get(content + "rate=10"), 400, "?rate");
  expect(get(content + "format=fap&rate=0"), 400, "?rate");
  expect(get(content + "from=301"), 409, "");
  expect(get(content + "format=recording&from=0"), 400, "?from");
  const auto frames = "/v1/recordings/" + recording + "/frames?";
  expect(get(frames + "at=86400001"), 400, "?at");
  expect(get(frames + "at=1&from=2"), 400, "?from");
  expect(get(frames + "limit=1001"), 400, "?limit");
  expect(get(frames + "after=one"), 400, "?after");
  const auto empty = record(id);
  expect(get("/v1/recordings/" + empty + "/content"), 409, "");
  expect(get("/v1/recordings/" + empty + "/frames?at=0"), 409, "");
  expect(post("/v1/streams/" + id + "/plays", {{"recording", empty}}), 409, "");
  EXPECT_TRUE(json_of(get("/v1/recordings/" + empty + "/frames"))["frames"].empty());
}

TEST_F(Recordings, IdempotencyKey_MakesOne) {
  const auto id = stream();
  const Fields fields = {{"Content-Type", "application/json"}, {"Idempotency-Key", "record-1"}};
  const auto target = "/v1/streams/" + id + "/recordings";
  const auto first = json_of(request(port(), "POST", target, "{}", fields));
  EXPECT_EQ(json_of(request(port(), "POST", target, "{}", fields))["id"], first["id"]);
}

TEST(RecordingLimits, AreAnsweredAndEndWhatRuns) {
  const TemporaryFolder folder;
  // A little more than is written at once at most: frames, sound and text.
  const ServerProcess server(folder.path() / "data", {"--max-recordings", "1", "--max-recording-bytes", "672000"});
  request(server.port(), "POST", "/v1/streams", R"({"name":"talk"})", json_type);
  const auto made = json_of(request(server.port(), "POST", "/v1/streams/talk/recordings"));
  const auto refused = request(server.port(), "POST", "/v1/streams/talk/recordings");
  EXPECT_EQ(refused.status, 507);
  EXPECT_EQ(json_of(refused)["type"], "/problems/limit-exceeded");
  json frames = json::array();
  std::mt19937 random(1);  // what can be predicted takes next to no bytes
  for (int i = 0; i < 500; ++i) {
    json faps = json::object();
    for (int fap = 3; fap <= 30; ++fap) faps[std::to_string(fap)] = 8 * (random() % 20);
    frames.push_back({{"time", i}, {"faps", faps}});
  }
  const auto body = json{{"frames", frames}}.dump();
  json now;
  for (int i = 0; i < 4; ++i)  // as many frames as may come at once
    EXPECT_EQ(request(server.port(), "POST", "/v1/streams/talk/frames", body, json_type).status, 202);
  testing::eventually([&] {
    now = json_of(request(server.port(), "GET", "/v1/recordings/" + made["id"].get<std::string>()));
    return now["state"] != "recording";
  });
  EXPECT_EQ(now["ended"], "max-bytes");
  EXPECT_LE(now["bytes"], 672000);
  EXPECT_GT(now["frames"], 0);
}

TEST(RecordingLimits, Exports_LeaveTheDiskReserve_AndOfAKilledServerNothingIsLeft) {
  const TemporaryFolder folder;
  const auto temporary = folder.path() / "data" / "tmp";
  std::string recording;
  {
    const ServerProcess server(folder.path() / "data", {});
    request(server.port(), "POST", "/v1/streams", R"({"name":"talk"})", json_type);
    const auto made = json_of(request(server.port(), "POST", "/v1/streams/talk/recordings"));
    recording = "/v1/recordings/" + made["id"].get<std::string>();
    request(server.port(), "POST", "/v1/streams/talk/frames", R"({"frames":[{"time":0,"faps":{"3":8}}]})", json_type);
    EXPECT_EQ(json_of(request(server.port(), "POST", recording + "/stop"))["frames"], 1);
    EXPECT_EQ(request(server.port(), "GET", recording + "/content?format=arkit-csv").status, 200);
  }
  std::ofstream(temporary / "export-0123456789ab") << "of a server that was killed";
  const ServerProcess server(folder.path() / "data", {"--disk-reserve", "1000000000000000"});
  EXPECT_TRUE(std::filesystem::is_empty(temporary));
  for (const char* const format : {"arkit-csv", "frames-json"}) {
    const auto refused = request(server.port(), "GET", recording + "/content?format=" + format);
    EXPECT_EQ(refused.status, 507) << format;
    EXPECT_EQ(json_of(refused)["type"], "/problems/insufficient-storage");
  }
  EXPECT_EQ(request(server.port(), "GET", recording + "/content?format=fap").status, 200) << "made in memory";
  EXPECT_EQ(request(server.port(), "GET", recording + "/content?format=recording").status, 200);
  EXPECT_TRUE(std::filesystem::is_empty(temporary));
}

TEST(RecordingLimits, NearlyFullDisk_IsSaid) {
  const TemporaryFolder folder;
  const ServerProcess server(folder.path() / "data", {"--disk-reserve", "1000000000000000"});
  request(server.port(), "POST", "/v1/streams", R"({"name":"talk"})", json_type);
  const auto refused = request(server.port(), "POST", "/v1/streams/talk/recordings");
  EXPECT_EQ(refused.status, 507);
  EXPECT_THAT(refused.body, HasSubstr("disk"));
}

}  // namespace
}  // namespace semblante::test
