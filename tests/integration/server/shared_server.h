#pragma once

#include <csignal>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/integration/server/test_client.h"

namespace semblante::test {

/// Tests that share a server, in a folder of its own: it is started by the suite's SetUpTestSuite() and must end well
/// after the last test. If it did not start, the suite fails without a test, with what the server said.
class SharedServer : public ::testing::Test {
 protected:
  static void start(const std::vector<std::string>& options = {}) {
    folder_ = std::make_unique<TemporaryFolder>();
    server_ = std::make_unique<ServerProcess>(folder_->path() / "data", options);
  }
  static void TearDownTestSuite() {
    // A test may have ended it.
    if (server_ && server_->pid() > 0) {
      EXPECT_EQ(server_->end(SIGTERM), 0) << "a server that is told to stop ends well";
    }
    server_.reset();
    folder_.reset();
  }
  static ServerProcess& server() { return *server_; }
  static int port() { return server_->port(); }

 private:
  static inline std::unique_ptr<TemporaryFolder> folder_;
  static inline std::unique_ptr<ServerProcess> server_;
};

}  // namespace semblante::test
