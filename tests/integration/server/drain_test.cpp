// SIGTERM: what has begun is finished, nothing new begins, and nobody misses what was accepted before.

#include <atomic>
#include <csignal>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/integration/server/model_flow.h"
#include "tests/integration/server/open_request.h"

namespace semblante::test {
namespace {

using namespace std::chrono_literals;
using nlohmann::json;
using ::testing::HasSubstr;

/// What a subscriber got until its connection was closed.
struct Received {
  std::uint64_t frames = 0, next = 0;  ///< number of frames; sequence after the last one
  bool gap = false;
  std::string end;
  int close_code = 0;
};

/// Reads to the end; `pause` after the first batch, as a phone in a tunnel.
Received read_all(WebSocket& socket, std::chrono::milliseconds pause) {
  Received got;
  while (const auto text = socket.receive()) {
    const auto message = json::parse(*text);
    if (message["type"] == "end") got.end = message["reason"];
    if (message["type"] != "frames") continue;
    const std::uint64_t first = message["sequence"];
    if (got.next != 0 && first != got.next) got.gap = true;
    got.frames += message["frames"].size();
    got.next = first + message["frames"].size();
    std::this_thread::sleep_for(std::exchange(pause, 0ms));
  }
  got.close_code = socket.close_code();
  return got;
}

TEST(Drain, ClosedTerminal_StopsAsSigtermDoes) {
  const TemporaryFolder data;
  ServerProcess server(data.path());
  ASSERT_EQ(request(server.port(), "POST", "/v1/streams", R"({"name":"talk"})", json_type).status, 201);
  WebSocket socket(server.port(), "/v1/streams/talk", "semblante.v1.json");
  socket.send_text(R"({"type":"hello","version":1,"role":"subscribe"})");
  ASSERT_TRUE(socket.receive()) << "its header";
  EXPECT_EQ(server.end(SIGHUP), 0);
  const auto received = read_all(socket, 0ms);
  EXPECT_EQ(received.end, "shutdown");
  EXPECT_EQ(received.close_code, 1001);
}

TEST(Drain, SignalsOfLogRotation_DoNotEndTheServer) {
  const TemporaryFolder data;
  ServerProcess server(data.path());
  for (const int number : {SIGUSR1, SIGUSR2}) {
    ASSERT_EQ(::kill(server.pid(), number), 0);
    EXPECT_EQ(request(server.port(), "GET", "/healthz").status, 200);
  }
  EXPECT_EQ(server.end(SIGTERM), 0);
}

TEST(Drain, UnderLoad_NoSubscriberMissesWhatWasAccepted_AndTheRecordingIsWhole) {
  const TemporaryFolder data;
  std::string recording;
  std::atomic<std::uint64_t> accepted = 0;
  {
    ServerProcess server(data.path());
    const int port = server.port();
    ASSERT_EQ(request(port, "POST", "/v1/streams", R"({"name":"talk","batch_interval":100})", json_type).status, 201);
    std::vector<std::unique_ptr<WebSocket>> sockets;
    for (int i = 0; i < 40; ++i) {
      sockets.push_back(std::make_unique<WebSocket>(port, "/v1/streams/talk", "semblante.v1.json"));
      sockets.back()->send_text(R"({"type":"hello","version":1,"role":"subscribe"})");
      ASSERT_TRUE(sockets.back()->receive()) << "its header";
    }
    recording = json_of(request(port, "POST", "/v1/streams/talk/recordings", "{}", json_type))["id"];
    std::vector<Received> received(sockets.size());
    std::vector<std::thread> readers;
    for (std::size_t i = 0; i < sockets.size(); ++i)
      readers.emplace_back([&, i] { received[i] = read_all(*sockets[i], i % 4 == 0 ? 900ms : 0ms); });
    std::atomic<bool> refused = false;
    std::thread publisher([&] {
      for (int i = 0; !refused; ++i) {
        const auto body = json{{"frames", {{{"faps", {{"3", i % 100}}}}}}}.dump();
        try {
          const auto reply = request(port, "POST", "/v1/streams/talk/frames", body, json_type);
          if (reply.status == 202)
            accepted = json_of(reply)["sequence"].get<std::uint64_t>();
          else
            refused = true;
        } catch (const std::exception&) {
          refused = true;
        }
        std::this_thread::sleep_for(5ms);
      }
    });
    EXPECT_TRUE(semblante::testing::eventually([&] { return accepted > 50 || refused; }));
    EXPECT_FALSE(refused);
    EXPECT_EQ(server.end(SIGTERM), 0);
    publisher.join();
    for (auto& reader : readers) reader.join();
    for (const auto& got : received) {
      EXPECT_FALSE(got.gap);
      EXPECT_GE(got.next, accepted + 1) << "every frame that was acknowledged";
      EXPECT_EQ(got.end, "shutdown");
      EXPECT_EQ(got.close_code, 1001);
    }
  }
  const ServerProcess again(data.path());
  const auto taken = json_of(request(again.port(), "GET", "/v1/recordings/" + recording));
  EXPECT_EQ(taken["state"], "finished");
  EXPECT_EQ(taken["ended"], "server-stopped");
  EXPECT_GE(taken["frames"], accepted - 1) << "it began after the stream did, before the first frame";
}

TEST(Drain, WhatHasBegun_IsFinished_AndNothingNewBegins) {
  const TemporaryFolder data;
  std::string job;
  {
    ServerProcess server(data.path(), {"--drain-seconds", "60"});
    const int port = server.port();
    ASSERT_EQ(request(port, "POST", "/v1/streams", R"({"name":"talk"})", json_type).status, 201);
    // An upload that has begun, and a connection that is kept open.
    const auto model = grid_obj(9);
    OpenRequest upload(port,
                       "POST /v1/models?filename=grid.obj HTTP/1.1\r\nHost: localhost\r\nContent-Type: model/obj\r\n"
                       "Content-Length: " +
                           std::to_string(model.size()) + "\r\n\r\n" + model.substr(0, 10));
    OpenRequest ready(port, "GET /readyz HTTP/1.1\r\nHost: localhost\r\n\r\n");
    OpenRequest creator(port, "GET /healthz HTTP/1.1\r\nHost: localhost\r\n\r\n");
    OpenRequest subscriber(port, "GET /healthz HTTP/1.1\r\nHost: localhost\r\n\r\n");
    EXPECT_EQ(ready.answer().status, 200);
    EXPECT_EQ(creator.answer().status, 200);
    EXPECT_EQ(subscriber.answer().status, 200);
    ::kill(server.pid(), SIGTERM);
    ASSERT_TRUE(semblante::testing::eventually([&] { return server.errors().find("stopping") != std::string::npos; }));
    EXPECT_THROW(request(port, "GET", "/healthz"), std::runtime_error) << "no new connection";
    ready.send("GET /readyz HTTP/1.1\r\nHost: localhost\r\n\r\n");
    const auto not_ready = ready.answer();
    EXPECT_EQ(not_ready.status, 503);
    EXPECT_EQ(json_of(not_ready)["type"], "/problems/stopping");
    EXPECT_EQ(not_ready.headers.at("connection"), "close");
    creator.send("POST /v1/streams HTTP/1.1\r\nHost: localhost\r\nContent-Length: 2\r\n\r\n{}");
    const auto not_made = creator.answer();
    EXPECT_EQ(not_made.status, 503);
    EXPECT_EQ(not_made.headers.at("retry-after"), "5");
    subscriber.send(
        "GET /v1/streams/talk HTTP/1.1\r\nHost: localhost\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
        "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n");
    EXPECT_EQ(subscriber.answer().status, 503);
    upload.send(model.substr(10));
    const auto made = upload.answer();
    EXPECT_EQ(made.status, 202) << made.body;
    job = json_of(made)["job"]["id"];
    EXPECT_EQ(server.end(0), 0);
  }
  const ServerProcess again(data.path());
  EXPECT_EQ(wait_for_job(again.port(), job)["state"], "done");
}

TEST(Drain, EndsAtItsDeadline) {
  const TemporaryFolder data;
  ServerProcess server(data.path(), {"--drain-seconds", "1"});
  const OpenRequest upload(server.port(),
                           "POST /v1/models?filename=a.obj HTTP/1.1\r\nHost: localhost\r\nContent-Length: 9\r\n\r\nv");
  ASSERT_TRUE(semblante::testing::eventually([&] { return !std::filesystem::is_empty(data.path() / "tmp"); }));
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(server.end(SIGTERM), 0);
  EXPECT_GE(std::chrono::steady_clock::now() - begin, 900ms);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, semblante::testing::patience / 2);
}

TEST(Drain, SecondSignal_EndsItAtOnce_AndLosesNothing) {
  const TemporaryFolder data;
  {
    ServerProcess server(data.path(), {"--drain-seconds", "3600"});
    ASSERT_EQ(request(server.port(), "POST", "/v1/streams", R"({"name":"talk"})", json_type).status, 201);
    const OpenRequest upload(
        server.port(), "POST /v1/models?filename=a.obj HTTP/1.1\r\nHost: localhost\r\nContent-Length: 9\r\n\r\nv");
    ASSERT_TRUE(semblante::testing::eventually([&] { return !std::filesystem::is_empty(data.path() / "tmp"); }));
    ::kill(server.pid(), SIGTERM);
    ASSERT_TRUE(semblante::testing::eventually([&] { return server.errors().find("stopping") != std::string::npos; }));
    EXPECT_EQ(server.end(SIGTERM), 128 + SIGTERM);
  }
  const ServerProcess again(data.path());
  EXPECT_EQ(request(again.port(), "GET", "/v1/streams/talk").status, 200);
}

TEST(Drain, JobThatAStopEnds_LosesNoAttempt) {
  const TemporaryFolder data;
  std::string job;
  // More stops than attempts.
  for (int stop = 0; stop < 5; ++stop) {
    ServerProcess server(data.path());
    if (job.empty())
      job = json_of(request(server.port(), "POST", "/v1/models?filename=slow.obj", grid_obj(700),
                            {{"Content-Type", "model/obj"}}))["job"]["id"];
    ASSERT_TRUE(semblante::testing::eventually(
        [&] { return json_of(request(server.port(), "GET", "/v1/jobs/" + job))["state"] != "queued"; }));
    EXPECT_EQ(server.end(SIGTERM), 0);
  }
  const ServerProcess server(data.path());
  EXPECT_EQ(wait_for_job(server.port(), job)["state"], "done");
}

}  // namespace
}  // namespace semblante::test
