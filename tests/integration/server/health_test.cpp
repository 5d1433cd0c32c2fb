// Whether the server says that it lives while it has nobody left to answer anything else.

#include <atomic>
#include <future>
#include <sqlite3.h>
#include <thread>

#include <gtest/gtest.h>

#include "tests/integration/server/test_client.h"

namespace semblante::test {
namespace {

std::string get(const std::string& target) {
  return "GET " + target + " HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n";
}

TEST(Health, IsAnsweredWhileTheOnlyWorkerWaitsForTheStore) {
  const TemporaryFolder folder;
  const ServerProcess server(folder.path() / "data", {"--threads", "1"});
  // Somebody else writes to the store: whoever wants to write waits for 5 s, in SQLite.
  sqlite3* store = nullptr;
  ASSERT_EQ(sqlite3_open((folder.path() / "data" / "semblante.sqlite").c_str(), &store), SQLITE_OK);
  ASSERT_EQ(sqlite3_exec(store, "BEGIN IMMEDIATE", nullptr, nullptr, nullptr), SQLITE_OK);
  std::atomic<bool> waits{true};
  std::thread writer([&] {
    while (waits) request(server.port(), "POST", "/v1/streams", "{}", {{"Content-Type", "application/json"}});
  });
  // Asked later, answered earlier than what the worker has to answer. Not so when the worker has just been free.
  bool overtakes = false;
  for (int attempt = 0; attempt < 20 && !overtakes; ++attempt) {
    const auto asked = std::async(
        std::launch::async, [&] { return raw_exchange(server.port(), get("/v1/streams"), std::chrono::seconds(30)); });
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    for (const char* target : {"/healthz", "/version"})
      EXPECT_EQ(parse_reply(raw_exchange(server.port(), get(target), std::chrono::seconds(30))).status, 200) << target;
    overtakes = asked.wait_for(std::chrono::seconds(0)) == std::future_status::timeout;
  }
  EXPECT_TRUE(overtakes);
  waits = false;
  sqlite3_exec(store, "ROLLBACK", nullptr, nullptr, nullptr);
  sqlite3_close(store);
  writer.join();
}

}  // namespace
}  // namespace semblante::test
