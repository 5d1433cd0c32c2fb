// What is left of connections that a stop cuts off.

#include <chrono>
#include <filesystem>
#include <memory>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "server/net/server.h"
#include "tests/support/wait.h"
#include "tests/unit/net/echo_application.h"
#include "tests/unit/net/raw_client.h"

namespace semblante::net {
namespace {

/// As many connections as there are kinds of waiting: for a request, for its header, for its body, and for messages.
TEST(Stop, ConnectionsThatItCutsOff_AreClosed_AndTheirPeersAreTold) {
  EchoApplication application;
  ServerConfig config;
  config.listeners.front().port = 0;
  config.upload_directory = std::filesystem::temp_directory_path();
  config.limits.drain_time = std::chrono::seconds(0);
  config.limits.header_timeout = config.limits.idle_timeout = config.limits.read_timeout = config.limits.body_grace =
      10 * testing::patience;
  auto server = std::make_unique<Server>(config, application);
  const auto port = server->listen().value().front();
  std::thread thread([&] { server->run([] {}); });

  const Client idle(port), head(port), body(port), messages(port);
  idle.send(get("/immediate"));
  EXPECT_TRUE(idle.read_head().starts_with("HTTP/1.1 200 "));
  head.send("GET / HTTP/1.1\r\nHost");
  body.send("POST /upload HTTP/1.1\r\nHost: localhost\r\nContent-Length: 50\r\nExpect: 100-continue\r\n\r\n");
  EXPECT_TRUE(body.read_head().starts_with("HTTP/1.1 100 "));
  messages.upgrade();
  ASSERT_TRUE(testing::eventually([&] { return server->counts().connections_open == 4; }));
  EXPECT_EQ(application.peers, 1);

  server->stop();
  thread.join();
  server->stop();  // too late for its threads
  server.reset();
  EXPECT_EQ(application.peers, 0) << "its connection still exists";
  for (const Client* client : {&idle, &head, &body, &messages}) EXPECT_TRUE(client->has_ended());
}

/// Upgrades arrive while the server stops: each of them is served or closed, and none is forgotten on its way from the
/// threads of requests to those of WebSockets.
TEST(Stop, UpgradesOnTheirWay_AreNotForgotten) {
  constexpr int rounds = 20, clients_of_one = 8;
  EchoApplication application;
  for (int round = 0; round < rounds; ++round) {
    ServerConfig config;
    config.listeners.front().port = 0;
    config.limits.drain_time = std::chrono::seconds(0);
    auto server = std::make_unique<Server>(config, application);
    const auto port = server->listen().value().front();
    std::thread thread([&] { server->run([] {}); });
    std::vector<std::unique_ptr<Client>> clients;
    for (int i = 0; i < clients_of_one; ++i) {
      clients.push_back(std::make_unique<Client>(port));
      clients.back()->send(Client::upgrade_request);
    }
    if (round % 2 == 0) std::this_thread::sleep_for(std::chrono::microseconds(100 * round));
    server->stop();
    thread.join();
    server.reset();
    ASSERT_EQ(application.peers, 0) << "in round " << round;
  }
}

}  // namespace
}  // namespace semblante::net
