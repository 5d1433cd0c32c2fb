// What one token may have: every limit, told before it is reached, kept after a restart, and nobody else's.

#include <atomic>
#include <map>
#include <memory>
#include <random>
#include <thread>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <nlohmann/json.hpp>
#include <sys/socket.h>

#include "tests/integration/cli/program.h"
#include "tests/integration/server/model_flow.h"
#include "tests/integration/server/open_request.h"

namespace semblante::test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

/// An upload that has begun and does not go on.
std::unique_ptr<OpenRequest> open_upload(int port, const std::string& token) {
  return std::make_unique<OpenRequest>(
      port, "POST /v1/models?filename=grid.obj HTTP/1.1\r\nHost: localhost\r\nAuthorization: Bearer " + token +
                "\r\nContent-Type: model/obj\r\nContent-Length: 100000\r\n\r\nv 0 0 0\n");
}

class QuotaTest : public ::testing::Test {
 protected:
  QuotaTest() {
    for (const auto& [name, scope] : {std::pair{"edit", "edit"}, {"edit 2", "edit"}, {"admin", "admin"}})
      tokens_[name] =
          first_line(run_semblante({"token", "create", "--data", data_.path().string(), "--scope", scope}).out);
  }
  void start(const std::vector<std::string>& limits) {
    server_.reset();
    std::vector<std::string> options = {"--require-tokens", "--client-requests", "0"};
    options.insert(options.end(), limits.begin(), limits.end());
    server_ = std::make_unique<ServerProcess>(data_.path(), options);
  }
  [[nodiscard]] int port() const { return server_->port(); }
  Reply as(const std::string& token, const std::string& method, const std::string& target, const std::string& body = {},
           Fields fields = {}) {
    fields.emplace_back("Authorization", "Bearer " + tokens_.at(token));
    if (!body.empty() && fields.size() == 1) fields.emplace_back("Content-Type", "application/json");
    return request(port(), method, target, body, fields);
  }
  Reply upload(const std::string& token, int side = 9) {
    return as(token, "POST", "/v1/models?name=Grid&filename=grid.obj", grid_obj(side), {{"Content-Type", "model/obj"}});
  }
  json wait_for(const std::string& job) {
    json now;
    EXPECT_TRUE(semblante::testing::eventually([&] {
      now = json_of(as("admin", "GET", "/v1/jobs/" + job));
      return now.value("state", "") != "queued" && now.value("state", "") != "running";
    }));
    return now;
  }
  std::string imported(const std::string& token, int side = 9) {
    const auto made = json_of(upload(token, side));
    if (!made.contains("job")) return made.dump();
    wait_for(made["job"]["id"]);
    return made["model"]["id"];
  }
  Reply add_stream(const std::string& token, const std::string& name) {
    return as(token, "POST", "/v1/streams", json{{"name", name}}.dump());
  }
  /// The row of a limit in /v1/usage.
  json usage(const std::string& token, const std::string& limit, const std::string& query = {}) {
    for (const auto& row : json_of(as(token, "GET", "/v1/usage" + query)).value("limits", json::array()))
      if (row["name"] == limit) return row;
    return {};
  }
  static void expect_refused(const Reply& reply, int status, const std::string& type, const std::string& limit,
                             std::uint64_t value) {
    ASSERT_EQ(reply.status, status) << reply.body;
    const auto problem = json_of(reply);
    EXPECT_EQ(problem["type"], "/problems/" + type);
    EXPECT_EQ(problem["limit"]["name"], limit);
    EXPECT_EQ(problem["limit"]["value"], value);
    EXPECT_THAT(std::string(problem["detail"]), HasSubstr("limit of " + std::to_string(value) + " " + limit));
    EXPECT_EQ(reply.headers.contains("retry-after"), status == 429);
  }

  TemporaryFolder data_;
  std::map<std::string, std::string> tokens_;
  std::unique_ptr<ServerProcess> server_;
};

TEST_F(QuotaTest, CreationsOfOneAddress_HaveARate_WhateverItsTokens) {
  start({"--client-creations", "3", "--trusted-proxy", "127.0.0.1"});
  const auto create = [&](const std::string& token, const std::string& address, const std::string& name) {
    return as(token, "POST", "/v1/streams", json{{"name", name}}.dump(),
              {{"Content-Type", "application/json"}, {"X-Forwarded-For", address}, {"X-Forwarded-Proto", "https"}});
  };
  EXPECT_EQ(create("edit", "203.0.113.5", "a").status, 201);
  EXPECT_EQ(create("edit 2", "203.0.113.5", "b").status, 201);
  EXPECT_EQ(create("edit", "203.0.113.5", "a").status, 409) << "what fails is counted as well";
  const auto refused = create("edit 2", "203.0.113.5", "c");
  EXPECT_EQ(refused.status, 429) << refused.body;
  EXPECT_EQ(json_of(refused)["type"], "/problems/too-many-requests");
  EXPECT_EQ(refused.headers.at("retry-after"), "20");
  EXPECT_EQ(create("edit 2", "203.0.113.6", "c").status, 201) << "another address";
  EXPECT_EQ(create("admin", "203.0.113.5", "d").status, 201);
  for (int i = 0; i < 5; ++i) EXPECT_EQ(add_stream("edit", "here" + std::to_string(i)).status, 201) << "this machine";
}

TEST_F(QuotaTest, Streams_AreToldBeforeTheLimit_Refused_AndCountedAfterARestart) {
  start({"--token-streams", "5"});
  for (const auto* name : {"a", "b", "c"}) {
    const auto made = add_stream("edit", name);
    EXPECT_EQ(made.status, 201);
    EXPECT_FALSE(made.headers.contains("x-quota-warning"));
  }
  EXPECT_EQ(usage("edit", "streams"), (json{{"name", "streams"}, {"used", 3}, {"limit", 5}, {"level", "ok"}}));
  EXPECT_EQ(add_stream("edit", "d").headers.at("x-quota-warning"), "streams;used=4;limit=5");
  EXPECT_EQ(usage("edit", "streams")["level"], "warning");
  EXPECT_EQ(add_stream("edit", "e").headers.at("x-quota-warning"), "streams;used=5;limit=5");
  EXPECT_EQ(usage("edit", "streams")["level"], "full");
  expect_refused(add_stream("edit", "f"), 507, "quota-exceeded", "streams", 5);
  EXPECT_EQ(add_stream("edit 2", "f").status, 201) << "another token has its own";
  for (int i = 0; i < 6; ++i) EXPECT_EQ(add_stream("admin", "admin" + std::to_string(i)).status, 201);
  EXPECT_TRUE(usage("admin", "streams")["limit"].is_null());
  EXPECT_EQ(usage("admin", "streams")["used"], 6);

  start({"--token-streams", "5"});
  expect_refused(add_stream("edit", "g"), 507, "quota-exceeded", "streams", 5);
  tokens_["stream"] = json_of(as("admin", "POST", "/v1/tokens", R"({"scope":"edit","stream":"a"})"))["secret"];
  EXPECT_EQ(usage("stream", "streams")["used"], 0) << "it has made none, and may ask all the same";
  EXPECT_EQ(as("edit", "DELETE", "/v1/streams/a").status, 204);
  EXPECT_EQ(add_stream("edit", "g").status, 201);
  start({"--token-streams", "0"});
  EXPECT_EQ(add_stream("edit", "h").status, 201) << "0 is no limit";
  EXPECT_TRUE(usage("edit", "streams")["limit"].is_null());
}

TEST_F(QuotaTest, Models_AndTheirBytes_AreRefused_AndFreedByDeleting) {
  start({"--token-models", "2"});
  const auto first = imported("edit");
  const auto used = usage("edit", "bytes")["used"].get<std::uint64_t>();
  EXPECT_GT(used, grid_obj(9).size()) << "what the import has made counts too";
  const auto second = imported("edit", 12);
  expect_refused(upload("edit"), 507, "quota-exceeded", "models", 2);
  EXPECT_EQ(as("edit", "DELETE", "/v1/models/" + second).status, 204);
  EXPECT_EQ(usage("edit", "bytes")["used"], used);

  // As much as there is, and nearly as much again: neither another file nor the results of a job have room.
  const auto limit = used + 100;
  start({"--token-bytes", std::to_string(limit)});
  expect_refused(upload("edit", 20), 507, "quota-exceeded", "bytes", limit);
  EXPECT_EQ(usage("edit", "models")["used"], 1);
  EXPECT_EQ(upload("edit 2", 5).status, 202);
  EXPECT_EQ(as("edit", "PUT", "/v1/models/" + first + "/feature-points", grid_points()).status, 200);
  const auto parametrized = as("edit", "POST", "/v1/models/" + first + "/parametrizations", "{}");
  ASSERT_EQ(parametrized.status, 202) << parametrized.body;
  EXPECT_THAT(parametrized.headers.at("x-quota-warning"), HasSubstr("bytes;used="));
  EXPECT_EQ(wait_for(json_of(parametrized)["id"])["state"], "done");
  EXPECT_EQ(usage("edit", "bytes")["level"], "full") << "a job that was accepted is not stopped";
  const auto again = as("edit", "POST", "/v1/models/" + first + "/parametrizations", "{}");
  ASSERT_EQ(again.status, 507);
  EXPECT_EQ(json_of(again)["limit"]["name"], "bytes");
  EXPECT_GT(json_of(again)["limit"]["used"], limit);
  EXPECT_EQ(as("admin", "POST", "/v1/models/" + first + "/parametrizations", "{}").status, 202);
  EXPECT_EQ(usage("admin", "bytes", "?token=" + tokens_.at("edit").substr(4, 12))["level"], "full");
  EXPECT_EQ(as("edit", "GET", "/v1/usage?token=" + tokens_.at("admin").substr(4, 12)).status, 403);
  EXPECT_EQ(as("admin", "GET", "/v1/usage?token=nothing").status, 404);
}

TEST_F(QuotaTest, RequestsAtTheSameTime_ExceedNoLimitTogether) {
  start({"--token-streams", "3", "--threads", "4"});
  std::atomic<int> made = 0;
  std::vector<std::thread> clients;
  for (int i = 0; i < 12; ++i)
    clients.emplace_back([&, i] { made += add_stream("edit", "s" + std::to_string(i)).status == 201 ? 1 : 0; });
  for (auto& client : clients) client.join();
  EXPECT_EQ(made, 3);
}

TEST_F(QuotaTest, Expressions_CountWithTheJobsThatMakeThem) {
  start({"--token-expressions", "1"});
  const std::string body = R"({"name":"Smile","kind":"expression","displacements":{"2.3":[0,10,0]}})";
  const auto made = as("edit", "POST", "/v1/expressions", body);
  ASSERT_EQ(made.status, 201) << made.body;
  expect_refused(as("edit", "POST", "/v1/expressions", body), 507, "quota-exceeded", "expressions", 1);
  EXPECT_EQ(as("edit", "DELETE", "/v1/expressions/" + json_of(made)["id"].get<std::string>()).status, 204);
  EXPECT_EQ(as("edit", "POST", "/v1/expressions", body).status, 201);
}

TEST_F(QuotaTest, Jobs_WaitForEachOther) {
  start({"--token-jobs", "2"});
  // A large model keeps the one worker busy.
  const auto busy = json_of(upload("admin", 500));
  std::vector<json> own;
  for (int i = 0; i < 2; ++i) own.push_back(json_of(upload("edit", 9 + i)));
  expect_refused(upload("edit", 12), 429, "too-many-requests", "jobs", 2);
  EXPECT_EQ(upload("edit 2").status, 202);
  for (const auto& made : own) wait_for(made["job"]["id"]);
  EXPECT_EQ(upload("edit", 12).status, 202);
}

TEST_F(QuotaTest, Uploads_AtTheSameTime) {
  start({"--token-uploads", "1"});
  const auto slow = open_upload(port(), tokens_.at("edit"));
  ASSERT_TRUE(semblante::testing::eventually([&] { return usage("edit", "uploads")["used"] == 1; }));
  expect_refused(upload("edit"), 429, "too-many-requests", "uploads", 1);
  EXPECT_EQ(upload("edit 2").status, 202);
  EXPECT_EQ(as("edit", "GET", "/v1/models").status, 200);
}

TEST_F(QuotaTest, UploadThatIsGone_GivesItsShareBack) {
  start({"--token-uploads", "1"});
  {
    const auto slow = open_upload(port(), tokens_.at("edit"));
    ASSERT_TRUE(semblante::testing::eventually([&] { return usage("edit", "uploads")["used"] == 1; }));
  }
  EXPECT_TRUE(semblante::testing::eventually([&] { return usage("edit", "uploads")["used"] == 0; }));
  EXPECT_EQ(upload("edit").status, 202);
}

TEST_F(QuotaTest, Recordings_AreCounted_AndEndAtTheLimitOfBytes) {
  start({"--token-recordings", "2", "--token-bytes", "1000000"});
  ASSERT_EQ(add_stream("edit", "talk").status, 201);
  const auto record = [&] { return as("edit", "POST", "/v1/streams/talk/recordings", "{}"); };
  const auto first = record();
  ASSERT_EQ(first.status, 201) << first.body;
  const std::string id = json_of(first)["id"];
  json frames = json::array();
  std::mt19937 random(1);  // what can be predicted takes next to no bytes
  for (int i = 0; i < 400; ++i) {
    json faps;
    for (int fap = 3; fap <= 68; ++fap) faps[std::to_string(fap)] = random() % 400;
    frames.push_back({{"t", i}, {"faps", faps}});
  }
  const auto body = json{{"frames", frames}}.dump();
  std::string state = "recording";
  EXPECT_TRUE(semblante::testing::eventually([&] {
    as("edit", "POST", "/v1/streams/talk/frames", body);
    state = json_of(as("edit", "GET", "/v1/recordings/" + id))["state"];
    return state != "recording";
  }));
  const auto recording = json_of(as("edit", "GET", "/v1/recordings/" + id));
  EXPECT_EQ(recording["ended"], "max-token-bytes");
  EXPECT_LE(recording["bytes"], 1'000'000);
  EXPECT_GT(recording["frames"], 0);
  EXPECT_EQ(record().status, 201);
  expect_refused(record(), 507, "quota-exceeded", "recordings", 2);
}

TEST_F(QuotaTest, ServerThatAsksForNoTokens_HasNoSuchLimits) {
  server_ = std::make_unique<ServerProcess>(data_.path(), std::vector<std::string>{"--token-streams", "1"});
  for (const auto* name : {"a", "b", "c"})
    EXPECT_EQ(
        request(port(), "POST", "/v1/streams", json{{"name", name}}.dump(), {{"Content-Type", "application/json"}})
            .status,
        201);
  const auto usage = json_of(request(port(), "GET", "/v1/usage"));
  EXPECT_TRUE(usage["token"].is_null());
  for (const auto& row : usage["limits"]) {
    EXPECT_TRUE(row["limit"].is_null()) << row;
    EXPECT_EQ(row["level"], "ok");
    if (row["name"] == "streams") {
      EXPECT_EQ(row["used"], 3);
    }
  }
}

}  // namespace
}  // namespace semblante::test
