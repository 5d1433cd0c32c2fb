// The real server on a disk that fills at the worst moments: it says so, loses nothing it acknowledged, and when there
// is room again everything reaches its end without a restart.
#include "tests/support/full_disk.h"

#include <csignal>
#include <fstream>
#include <functional>
#include <sched.h>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/mount.h>

#include "tests/integration/server/model_flow.h"
#include "tests/support/wait.h"

namespace semblante::test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

class FullDiskTest : public ::testing::Test {
 protected:
  void start(std::vector<std::string> options = {}) {
    options.insert(options.end(), {"--disk-reserve", "0"});
    server_.reset();
    server_ = std::make_unique<ServerProcess>(folder_.path() / "data", options);
  }
  Reply ask(const std::string& method, const std::string& target, const std::string& body = {},
            const Fields& fields = json_type) const {
    return request(server_->port(), method, target, body, fields);
  }
  json get(const std::string& target) const { return json_of(ask("GET", target)); }
  bool wait_until_ready() const {
    return testing::eventually([this] { return ask("GET", "/readyz").status == 200; });
  }
  bool wait_until_not_ready() const {
    return testing::eventually([this] { return ask("GET", "/readyz").status == 503; });
  }
  void expect_degraded(const std::string& pending) const {
    EXPECT_EQ(ask("GET", "/healthz").status, 200);
    const auto ready = ask("GET", "/readyz");
    EXPECT_EQ(ready.status, 503);
    EXPECT_EQ(json_of(ready)["type"], "/problems/storage-unavailable");
    EXPECT_THAT(ready.body, HasSubstr("the disk is full"));
    EXPECT_THAT(ready.body, HasSubstr(pending));
    const auto metrics = ask("GET", "/metrics").body;
    EXPECT_THAT(metrics, HasSubstr("\nsemblante_store_writable 0\n"));
    EXPECT_THAT(metrics, HasSubstr("\nsemblante_store_disk_full 1\n"));
    if (pending.empty()) return;
    EXPECT_THAT(metrics, ::testing::Not(HasSubstr("\nsemblante_store_pending_writes 0\n")));
  }
  static void expect_full(const Reply& reply, const std::string& what) {
    EXPECT_EQ(reply.status, 507) << what << ": " << reply.body;
    EXPECT_EQ(json_of(reply).value("type", ""), "/problems/insufficient-storage") << what;
    EXPECT_THAT(reply.body, ::testing::Not(HasSubstr(folder_name()))) << what << " says where things are";
  }
  static std::string folder_name() { return "semblante-test-"; }
  std::string start_recording(int frames) {
    ask("POST", "/v1/streams", R"({"name":"talk"})");
    const std::string id = json_of(ask("POST", "/v1/streams/talk/recordings"))["id"];
    say(frames);
    return id;
  }
  void say(int frames) const {
    for (int i = 0; i < frames; ++i)
      EXPECT_EQ(ask("POST", "/v1/streams/talk/frames", R"({"frames":[{"faps":{"3":80}}]})").status, 202);
  }
  /// Room comes back: the job is done, and the server has nothing left to write.
  void free_and_expect_done(const std::string& job) {
    disk_.free();
    EXPECT_EQ(wait_for_job(server_->port(), job)["state"], "done");
    EXPECT_TRUE(wait_until_ready());
  }
  void wait_until_durable(const std::string& recording, std::size_t frames) const {
    EXPECT_TRUE(testing::eventually([&] { return get("/v1/recordings/" + recording)["frames"] == frames; }));
  }

  TemporaryFolder folder_;
  FullDisk disk_{folder_.path() / "data"};
  std::unique_ptr<ServerProcess> server_;
};

TEST_F(FullDiskTest, DuringAnImport_ItIsDoneWithRoom) {
  start();
  disk_.fill_after_removal("/tmp/job-");  // the first result has its place: the rest and the commit have none
  const auto made = json_of(ask("POST", "/v1/models?filename=grid.obj", grid_obj(9), obj_type));
  const std::string job = made["job"]["id"];
  const std::string model = "/v1/models/" + made["model"]["id"].get<std::string>();
  ASSERT_TRUE(wait_until_not_ready());
  EXPECT_TRUE(disk_.is_full());
  expect_degraded("job " + job);
  EXPECT_EQ(get("/v1/jobs/" + job)["state"], "queued");
  EXPECT_EQ(get("/v1/jobs/" + job)["stage"], "waiting for disk space");
  EXPECT_EQ(get(model)["state"], "importing");
  free_and_expect_done(job);
  EXPECT_EQ(get(model)["state"], "ready");
  EXPECT_EQ(ask("GET", model + "/preview.glb").status, 200);
}

TEST_F(FullDiskTest, DuringAParametrization_ItIsDoneWithRoom) {
  start();
  const auto id = import_grid(server_->port());
  const auto model = "/v1/models/" + id;
  ASSERT_EQ(ask("PUT", model + "/feature-points", grid_points()).status, 200);
  disk_.fill_after_removal("/tmp/job-");
  const std::string job = json_of(ask("POST", model + "/parametrizations"))["id"];
  ASSERT_TRUE(wait_until_not_ready());
  EXPECT_EQ(get(model)["state"], "ready") << "as before";
  EXPECT_EQ(get("/v1/jobs/" + job)["state"], "queued");
  free_and_expect_done(job);
  EXPECT_EQ(get(model)["state"], "parametrized");
  EXPECT_EQ(ask("GET", model + "/face.glb").status, 200);
}

TEST_F(FullDiskTest, UnderAWorkerThatWrites_ItsJobIsDoneWithRoom) {
  start();
  const auto made = json_of(ask("POST", "/v1/models?filename=grid.obj", grid_obj(300), obj_type));
  const std::string job = made["job"]["id"];
  ASSERT_TRUE(testing::eventually([&] { return get("/v1/jobs/" + job)["state"] == "running"; }));
  disk_.fill();
  ASSERT_TRUE(wait_until_not_ready());
  EXPECT_NE(get("/v1/jobs/" + job)["state"], "done");
  free_and_expect_done(job);
}

TEST_F(FullDiskTest, DuringARecording_ItEndsWithWhatWasDurable) {
  start();
  const auto id = start_recording(10);
  const auto recording = "/v1/recordings/" + id;
  wait_until_durable(id, 10);
  disk_.fill();
  say(5);
  ASSERT_TRUE(wait_until_not_ready());
  expect_degraded("the end of recording " + id);
  EXPECT_EQ(get(recording)["state"], "recording");
  expect_full(ask("POST", recording + "/stop"), "stop");
  EXPECT_EQ(get(recording + "/frames")["frames"].size(), 10U);
  disk_.free();
  ASSERT_TRUE(testing::eventually([&] { return get(recording)["state"] == "finished"; }));
  EXPECT_EQ(get(recording)["ended"], "disk-full");
  EXPECT_EQ(get(recording)["frames"], 10);
  EXPECT_EQ(ask("GET", recording + "/content?format=fap").status, 200);
  EXPECT_TRUE(wait_until_ready());
}

TEST_F(FullDiskTest, AtAStop_ItIsRecordedWithRoom) {
  start();
  const auto id = start_recording(10);
  wait_until_durable(id, 10);
  disk_.fill();
  const auto refused = ask("POST", "/v1/recordings/" + id + "/stop");
  expect_full(refused, "stop");
  EXPECT_THAT(refused.body, HasSubstr("the recording has ended"));
  expect_degraded("the end of recording " + id);
  disk_.free();
  ASSERT_TRUE(testing::eventually([&] { return get("/v1/recordings/" + id)["state"] == "finished"; }));
  EXPECT_EQ(get("/v1/recordings/" + id)["ended"], "stopped");
  EXPECT_EQ(ask("POST", "/v1/recordings/" + id + "/stop").status, 200);
  EXPECT_TRUE(wait_until_ready());
}

TEST_F(FullDiskTest, AtACancel_ItIsRecordedWithRoom) {
  start();
  const auto first = json_of(ask("POST", "/v1/models?filename=big.obj", grid_obj(700), obj_type));
  const auto second = json_of(ask("POST", "/v1/models?filename=grid.obj", grid_obj(9), obj_type));
  const std::string runs = "/v1/jobs/" + first["job"]["id"].get<std::string>();
  const std::string waits = "/v1/jobs/" + second["job"]["id"].get<std::string>();
  ASSERT_TRUE(testing::eventually([&] { return get(runs)["state"] == "running"; }));
  ASSERT_EQ(get(waits)["state"], "queued");
  disk_.fill();
  for (const auto& job : {waits, runs}) {
    const auto refused = ask("DELETE", job);
    expect_full(refused, job);
    EXPECT_THAT(refused.body, HasSubstr("the job is cancelled"));
    EXPECT_THAT(get(job)["state"], ::testing::AnyOf("queued", "running")) << "not durable yet";
  }
  ASSERT_TRUE(wait_until_not_ready());
  disk_.free();
  for (const auto& made : {first, second}) {
    EXPECT_EQ(wait_for_job(server_->port(), made["job"]["id"])["state"], "cancelled");
    EXPECT_EQ(get("/v1/models/" + made["model"]["id"].get<std::string>())["state"], "failed");
  }
  EXPECT_TRUE(wait_until_ready());
}

TEST_F(FullDiskTest, EveryChangeSays507_AndWorksWithRoom) {
  start();
  const auto id = import_grid(server_->port());
  ASSERT_EQ(parametrize_grid(server_->port(), id)["state"], "done");
  const auto model = "/v1/models/" + id;
  const std::string set_body = R"({"name":"Grin","kind":"viseme","displacements":{"2.3":[1,0,0]}})";
  const auto created_set = ask("POST", "/v1/expressions", set_body);
  ASSERT_EQ(created_set.status, 201) << created_set.body;
  const std::string set = "/v1/expressions/" + json_of(created_set)["id"].get<std::string>();
  const auto recorded = start_recording(3);
  ASSERT_EQ(ask("POST", "/v1/recordings/" + recorded + "/stop").status, 200);
  const std::string boundary = "----b";
  const std::string form = "--" + boundary +
                           "\r\nContent-Disposition: form-data; name=\"file\"; filename=\"g.obj\"\r\n\r\n" +
                           grid_obj(9) + "\r\n--" + boundary + "--\r\n";
  const Fields form_type = {{"Content-Type", "multipart/form-data; boundary=" + boundary}};
  struct Change {
    std::string method, target, body;
    Fields fields = json_type;
  };
  // In an order in which each can be made after those before it.
  const std::vector<Change> changes = {
      {"PATCH", model, R"({"name":"Renamed"})"},
      {"PATCH", model, R"({"frame":{"unit":"cm"}})"},
      {"PATCH", model, R"({"roles":{"0":"skin"}})"},
      {"PUT", model + "/feature-points", grid_points()},
      {"POST", model + "/parametrizations", {}},
      {"POST", "/v1/models?filename=grid.obj", grid_obj(9), obj_type},
      {"POST", "/v1/models", form, form_type},
      {"POST", "/v1/expressions", set_body},
      {"PUT", set, set_body},
      {"DELETE", set, {}},
      {"POST", "/v1/streams", R"({"name":"new"})"},
      {"POST", "/v1/streams/talk/recordings", {}},
      {"GET", "/v1/recordings/" + recorded + "/content?format=arkit-csv", {}},
      {"DELETE", "/v1/recordings/" + recorded, {}},
      {"DELETE", "/v1/streams/talk", {}},
      {"DELETE", model, {}},
  };
  disk_.fill();
  for (const auto& change : changes)
    expect_full(ask(change.method, change.target, change.body, change.fields), change.method + " " + change.target);
  expect_degraded("");
  EXPECT_EQ(get(model)["name"], "Grid") << "nothing was changed";
  EXPECT_EQ(get(set)["name"], "Grin");
  EXPECT_EQ(ask("GET", "/v1/streams/new").status, 404);
  for (const std::string part : {"", "/face.glb", "/mesh.drc", "/rig.json", "/feature-points"})
    EXPECT_EQ(ask("GET", model + part).status, 200) << part << " can be read";
  disk_.free();
  EXPECT_TRUE(wait_until_ready());
  for (const auto& change : changes) {
    const auto reply = ask(change.method, change.target, change.body, change.fields);
    EXPECT_TRUE(reply.status >= 200 && reply.status < 300)
        << change.method << " " << change.target << ": " << reply.status << " " << reply.body;
    if (reply.headers.contains("location") && reply.headers.at("location").starts_with("/v1/jobs/"))
      wait_for_job(server_->port(), reply.headers.at("location").substr(9));
  }
}

TEST(RealFullDisk, IsSaid_CanBeEmptied_AndHeals) {
  const TemporaryFolder folder;
  const auto data = folder.path() / "data";
  std::filesystem::create_directory(data);
  // A small disk of its own, which goes with this process.
  if (::unshare(CLONE_NEWNS) != 0 || ::mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0 ||
      ::mount("none", data.c_str(), "tmpfs", 0, "size=24m") != 0)
    GTEST_SKIP() << "this process may not mount a file system";
  {
    ServerProcess server(data, {"--disk-reserve", "0"});
    const int port = server.port();
    const auto id = import_grid(port);
    ASSERT_EQ(parametrize_grid(port, id)["state"], "done");
    request(port, "POST", "/v1/streams", R"({"name":"talk"})", json_type);
    const std::string recording =
        "/v1/recordings/" + json_of(request(port, "POST", "/v1/streams/talk/recordings"))["id"].get<std::string>();
    {
      std::ofstream filler(data / "filler");
      while (filler << std::string(4096, 'x') << std::flush) {
      }
    }
    const auto refused = request(port, "POST", "/v1/models?filename=grid.obj", grid_obj(300), obj_type);
    EXPECT_EQ(refused.status, 507) << refused.body;
    EXPECT_EQ(json_of(refused)["type"], "/problems/insufficient-storage");
    EXPECT_EQ(request(port, "GET", "/readyz").status, 503);
    EXPECT_EQ(request(port, "GET", "/v1/models/" + id + "/face.glb").status, 200);
    EXPECT_EQ(request(port, "DELETE", "/v1/models/" + id).status, 204) << "a full disk can be emptied";
    EXPECT_EQ(request(port, "POST", recording + "/stop").status, 200) << "the reserve has room for ends";
    std::this_thread::sleep_for(std::chrono::seconds(1));  // several probes
    EXPECT_EQ(request(port, "GET", "/readyz").status, 503) << "while it lasts";
    std::filesystem::remove(data / "filler");
    EXPECT_TRUE(testing::eventually([&] { return request(port, "GET", "/readyz").status == 200; }));
    EXPECT_EQ(request(port, "GET", "/v1/models/" + id).status, 404);
    EXPECT_EQ(json_of(request(port, "GET", recording))["state"], "finished");
  }
  ::umount2(data.c_str(), MNT_DETACH);
}

TEST(RealFullDisk, StartsOnIt) {
  const TemporaryFolder folder;
  const auto data = folder.path() / "data";
  std::filesystem::create_directory(data);
  if (::unshare(CLONE_NEWNS) != 0 || ::mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0 ||
      ::mount("none", data.c_str(), "tmpfs", 0, "size=24m") != 0)
    GTEST_SKIP() << "this process may not mount a file system";
  for (const int signal : {SIGKILL, SIGTERM}) {
    json made;
    {
      ServerProcess server(data);
      made = json_of(request(server.port(), "POST", "/v1/models?filename=grid.obj", grid_obj(100), obj_type));
      if (signal == SIGTERM) wait_for_job(server.port(), made["job"]["id"]);
      server.end(signal);
    }
    {
      std::ofstream filler(data / "filler");
      while (filler << std::string(4096, 'x') << std::flush) {
      }
    }
    ServerProcess server(data);
    EXPECT_EQ(request(server.port(), "GET", "/v1/models/" + made["model"]["id"].get<std::string>()).status, 200);
    std::filesystem::remove(data / "filler");
    EXPECT_EQ(wait_for_job(server.port(), made["job"]["id"])["state"], "done");
  }
  ::umount2(data.c_str(), MNT_DETACH);
}

class FullDiskSampleTest : public FullDiskTest {
 protected:
  FullDiskSampleTest() {
    std::ofstream(folder_.path() / "head.obj") << grid_obj(9);
    auto points = json::parse(grid_points());
    points["format"] = "semblante.feature-points";
    points["version"] = 1;
    std::ofstream(folder_.path() / "head.fps.json") << points.dump();
  }
  void start_with_sample() { start({"--sample", (folder_.path() / "head.obj").string()}); }
  bool wait_for_sample() const {
    return testing::eventually([this] { return get("/v1/models/sample").value("state", "") == "parametrized"; });
  }
};

TEST_F(FullDiskSampleTest, DuringItsImport) {
  disk_.fill_after_removal("/tmp/job-");
  start_with_sample();
  ASSERT_TRUE(wait_until_not_ready());
  EXPECT_TRUE(disk_.is_full());
  disk_.free();
  EXPECT_TRUE(wait_for_sample());
  EXPECT_TRUE(wait_until_ready());
}

TEST_F(FullDiskSampleTest, AtTheCommitAfterItsImport) {
  disk_.fill_after_removal(".stderr");  // the last file of the import's worker goes after the import's commit
  start_with_sample();
  ASSERT_TRUE(wait_until_not_ready()) << "the server is there and says so";
  expect_degraded("the next step of the sample head");
  EXPECT_EQ(get("/v1/models/sample")["state"], "ready");
  disk_.free();
  EXPECT_TRUE(wait_for_sample());
  EXPECT_TRUE(wait_until_ready());
}

TEST_F(FullDiskSampleTest, AtItsStart) {
  start();
  server_->end(SIGTERM);
  disk_.fill();
  start_with_sample();
  expect_degraded("the next step of the sample head");
  EXPECT_EQ(ask("GET", "/v1/models/sample").status, 404);
  disk_.free();
  EXPECT_TRUE(wait_for_sample());
  EXPECT_TRUE(wait_until_ready());
}

TEST_F(FullDiskTest, AtTheStart_ServerReadsAndStreams_AndRepairsWithRoom) {
  start();
  const auto kept = import_grid(server_->port());
  const auto recording = start_recording(10);
  wait_until_durable(recording, 10);
  const auto made = json_of(ask("POST", "/v1/models?filename=big.obj", grid_obj(300), obj_type));
  const std::string job = made["job"]["id"];
  server_->end(SIGKILL);
  disk_.fill();
  start();
  expect_degraded("recording " + recording);
  EXPECT_THAT(ask("GET", "/readyz").body, HasSubstr("job " + job));
  EXPECT_THAT(server_->errors(), HasSubstr("the disk is full"));
  EXPECT_EQ(ask("GET", "/v1/models/" + kept + "/preview.glb").status, 200);
  EXPECT_EQ(get("/v1/recordings/" + recording)["state"], "recording");
  EXPECT_EQ(get("/v1/recordings/" + recording + "/frames")["frames"].size(), 10U);
  WebSocket subscriber(server_->port(), "/v1/streams/talk", "semblante.v1.json");
  ASSERT_EQ(subscriber.handshake().status, 101);
  subscriber.send_text(R"({"type":"hello","role":"subscriber"})");
  say(1);
  EXPECT_TRUE(subscriber.receive()) << "live streams need no disk";
  disk_.free();
  EXPECT_EQ(wait_for_job(server_->port(), job)["state"], "done");
  ASSERT_TRUE(testing::eventually([&] { return get("/v1/recordings/" + recording)["state"] == "finished"; }));
  EXPECT_EQ(get("/v1/recordings/" + recording)["ended"], "server-killed");
  EXPECT_EQ(get("/v1/recordings/" + recording)["frames"], 10);
  EXPECT_TRUE(wait_until_ready());
}

TEST_F(FullDiskTest, AtTheStart_AfterAnOrderlyStop) {
  start();
  const auto kept = import_grid(server_->port());
  EXPECT_EQ(server_->end(SIGTERM), 0);
  disk_.fill();
  start();
  EXPECT_EQ(get("/v1/models/" + kept)["state"], "ready");
  expect_full(ask("POST", "/v1/streams", R"({"name":"new"})"), "POST");
  disk_.free();
  EXPECT_TRUE(wait_until_ready());
  EXPECT_EQ(ask("POST", "/v1/streams", R"({"name":"new"})").status, 201);
}

TEST_F(FullDiskTest, AtTheFirstStart_SaysSo) {
  std::filesystem::create_directory(folder_.path() / "data");
  disk_.fill();
  EXPECT_THAT([&] { start(); }, ::testing::ThrowsMessage<std::runtime_error>(HasSubstr("No space left on device")));
}

TEST_F(FullDiskTest, KilledWhileAnEndIsPending_TheNextStartFindsIt) {
  start();
  const auto recording = start_recording(10);
  wait_until_durable(recording, 10);
  const auto made = json_of(ask("POST", "/v1/models?filename=grid.obj", grid_obj(300), obj_type));
  const std::string job = made["job"]["id"];
  ASSERT_TRUE(testing::eventually([&] { return get("/v1/jobs/" + job)["state"] == "running"; }));
  disk_.fill();
  expect_full(ask("POST", "/v1/recordings/" + recording + "/stop"), "stop");
  ASSERT_TRUE(testing::eventually([&] { return get("/v1/jobs/" + job)["stage"] == "waiting for disk space"; }));
  server_->end(SIGKILL);
  disk_.free();
  start();
  EXPECT_EQ(wait_for_job(server_->port(), job)["state"], "done");
  EXPECT_EQ(get("/v1/recordings/" + recording)["state"], "finished");
  EXPECT_EQ(get("/v1/recordings/" + recording)["frames"], 10);
  EXPECT_EQ(ask("GET", "/readyz").status, 200);
}

TEST_F(FullDiskTest, StopsInOrder_WhileAnEndIsPending) {
  start();
  const auto recording = start_recording(10);
  wait_until_durable(recording, 10);
  disk_.fill();
  expect_full(ask("POST", "/v1/recordings/" + recording + "/stop"), "stop");
  EXPECT_EQ(server_->end(SIGTERM), 0);
  EXPECT_THAT(server_->errors(), HasSubstr("could not be recorded"));
}

TEST_F(FullDiskTest, IsLoggedOnce_NotAtEachRetry) {
  start();
  const auto recording = start_recording(10);
  wait_until_durable(recording, 10);
  disk_.fill();
  expect_full(ask("POST", "/v1/recordings/" + recording + "/stop"), "stop");
  std::this_thread::sleep_for(std::chrono::seconds(2));  // several retries
  disk_.free();
  ASSERT_TRUE(wait_until_ready());
  const auto log = server_->errors();
  const auto count = [&](const std::string& text) {
    std::size_t times = 0;
    for (auto at = log.find(text); at != std::string::npos; at = log.find(text, at + 1)) ++times;
    return times;
  };
  EXPECT_EQ(count("what must be recorded is kept and tried again"), 1U) << log;
  EXPECT_EQ(count("can be written again"), 1U) << log;
}

}  // namespace
}  // namespace semblante::test
