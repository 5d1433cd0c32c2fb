#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <thread>

#include <gtest/gtest.h>

#include "server/net/server.h"
#include "tests/support/wait.h"
#include "tests/unit/net/echo_application.h"

namespace semblante::net {

/// A server of this application, and any test's clients of it.
class ServerFixture : public ::testing::Test {
 protected:
  ServerFixture() {
    ServerConfig config;
    config.listeners.front().port = 0;
    config.worker_threads = workers;
    config.limits.max_files = max_files;
    config.upload_directory = std::filesystem::temp_directory_path();
    // So long that whoever waits for one of these does not pass.
    config.limits.header_timeout = config.limits.idle_timeout = config.limits.drain_time =
        10 * semblante::testing::patience;
    server_ = std::make_unique<Server>(config, application_);
    port_ = server_->listen().value().front();
    thread_ = std::thread([this] { server_->run([] {}); });
  }
  ~ServerFixture() override {
    EXPECT_TRUE(semblante::testing::eventually([&] { return server_->counts().connections_open == 0; }));
    server_->stop();
    thread_.join();
  }

  static constexpr int workers = 2;
  static constexpr std::uint32_t max_files = 3;
  EchoApplication application_;
  std::unique_ptr<Server> server_;
  std::uint16_t port_ = 0;
  std::thread thread_;
};

}  // namespace semblante::net
