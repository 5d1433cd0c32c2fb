// Many connections send requests with one Idempotency-Key at the same moment to a real server, on every route that
// takes the key.

#include <algorithm>
#include <array>
#include <atomic>
#include <barrier>
#include <csignal>
#include <set>
#include <thread>

#include <gtest/gtest.h>

#include "core/propose/quick_set.h"
#include "tests/integration/server/model_flow.h"

namespace semblante::test {
namespace {

using nlohmann::json;

constexpr std::size_t connections = 16;
constexpr int rounds = 5;

struct Call {
  std::string target, body, type = "application/json";
};

/// One request for each call, all at the same moment.
std::vector<Reply> at_once(int port, const std::vector<Call>& calls, const std::vector<std::string>& keys) {
  std::vector<Reply> replies(calls.size());
  std::barrier together(static_cast<std::ptrdiff_t>(calls.size()));
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < calls.size(); ++i)
    threads.emplace_back([&, i] {
      together.arrive_and_wait();
      replies[i] = request(port, "POST", calls[i].target, calls[i].body,
                           {{"Content-Type", calls[i].type}, {"Idempotency-Key", keys[i % keys.size()]}});
    });
  for (auto& thread : threads) thread.join();
  return replies;
}

std::string id_in(const Reply& reply) {
  const auto body = json_of(reply);
  return body.contains("model") && body["model"].is_object() ? body["model"].value("id", "") : body.value("id", "");
}

class Idempotency : public ::testing::Test {
 protected:
  /// `count` is what one creation raises by one; nothing where it cannot be counted from outside.
  void expect_one(const Call& call, int status, const std::function<std::size_t()>& count = {}) {
    for (int round = 0; round < rounds; ++round) {
      const auto key = call.target + std::to_string(call.body.size()) + "-" + std::to_string(round);
      const auto before = count ? count() : 0;
      auto replies = at_once(port(), std::vector<Call>(connections, call), {key});
      replies.push_back(at_once(port(), {call}, {key}).front());  // a retry afterwards
      for (const auto& reply : replies) {
        ASSERT_EQ(reply.status, status) << call.target << reply.body;
        ASSERT_EQ(reply.headers.at("location"), replies[0].headers.at("location"));
        ASSERT_EQ(id_in(reply), id_in(replies[0]));
        ASSERT_NE(id_in(reply), "");
      }
      if (count) {
        ASSERT_EQ(count(), before + 1) << call.target;
      }
      last_ = {call, key, replies[0]};
    }
  }
  std::function<std::size_t()> listed(const std::string& target, const std::string& member) {
    return [this, target, member] { return json_of(request(port(), "GET", target))[member].size(); };
  }
  [[nodiscard]] int port() const { return server_->port(); }

  TemporaryFolder folder_;
  std::unique_ptr<ServerProcess> server_ =
      std::make_unique<ServerProcess>(folder_.path() / "data", std::vector<std::string>{"--threads", "8"});
  struct {
    Call call;
    std::string key;
    Reply reply;
  } last_;
};

TEST_F(Idempotency, EveryRoute_MakesOne_AndKnowsItAfterAKill) {
  expect_one({"/v1/models?filename=a.obj", grid_obj(4), "model/obj"}, 202, listed("/v1/models?limit=200", "models"));
  const auto model = import_grid(port());
  request(port(), "PUT", "/v1/models/" + model + "/feature-points", grid_points(),
          {{"Content-Type", "application/json"}});
  expect_one({"/v1/models/" + model + "/parametrizations", "{}"}, 202);
  expect_one({"/v1/expressions", R"({"name":"Grin","displacements":{}})"}, 201,
             listed("/v1/expressions?limit=200", "sets"));
  expect_one({"/v1/streams", "{}"}, 201, listed("/v1/streams?limit=200", "streams"));
  request(port(), "POST", "/v1/streams", R"({"name":"talk"})", {{"Content-Type", "application/json"}});
  expect_one({"/v1/streams/talk/recordings", "{}"}, 201, listed("/v1/recordings?limit=200", "recordings"));
  // Enough points for a proposal to begin; what becomes of it on a grid does not matter here.
  json points = {{"points", json::object()}};
  int vertex = 0;
  for (const auto& id : quick_set) points["points"][std::string(id)] = {{"vertex", vertex++}};
  request(port(), "PUT", "/v1/models/" + model + "/feature-points", points.dump(),
          {{"Content-Type", "application/json"}});
  expect_one({"/v1/models/" + model + "/feature-points/proposals", ""}, 202);
  const auto body = json{{"model", model}, {"target", "none"}}.dump();
  for (const auto& reply : at_once(port(), std::vector<Call>(connections, {"/v1/expressions", body}), {"fails"}))
    EXPECT_EQ(reply.status, 422) << "a grid has no morph targets" << reply.body;

  expect_one({"/v1/streams", R"({"title":"Last"})"}, 201);
  EXPECT_EQ(server_->end(SIGKILL), -SIGKILL);
  server_ = std::make_unique<ServerProcess>(folder_.path() / "data");
  const auto again = at_once(port(), std::vector<Call>(connections, last_.call), {last_.key});
  for (const auto& reply : again) {
    EXPECT_EQ(reply.status, 201);
    EXPECT_EQ(id_in(reply), id_in(last_.reply));
  }
}

TEST_F(Idempotency, NamedStream_IsNoConflictForItsOwnKey_AndOneForOthers) {
  for (int round = 0; round < rounds; ++round) {
    const auto number = std::to_string(round);
    const Call call{"/v1/streams", R"({"name":"mine)" + number + "\"}"};
    for (const auto& reply : at_once(port(), std::vector<Call>(connections, call), {"k" + number}))
      ASSERT_EQ(reply.status, 201) << reply.body;
    const Call contested{"/v1/streams", R"({"name":"contested)" + number + "\"}"};
    std::map<std::string, std::set<int>> statuses;
    const std::vector<std::string> keys = {"x" + number, "y" + number};
    const auto replies = at_once(port(), std::vector<Call>(connections, contested), keys);
    for (std::size_t i = 0; i < replies.size(); ++i) statuses[keys[i % 2]].insert(replies[i].status);
    const bool first_won = statuses[keys[0]] == std::set{201};
    EXPECT_EQ(statuses[keys[first_won ? 0 : 1]], std::set{201});
    EXPECT_EQ(statuses[keys[first_won ? 1 : 0]], std::set{409});
  }
}

/// Each answer 201 is followed by one 204 before the next 201, and what remains is what the next start finds.
TEST_F(Idempotency, StreamsOfOneName_CreatedAndRemovedAtOnce_AreWhatTheAnswersSay) {
  constexpr int names = 3;
  std::array<std::atomic<int>, names> there{};
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < connections; ++i)
    threads.emplace_back([&, i] {
      for (int n = 0; n < 60; ++n) {
        const int name = n % names;
        const auto stream = "race-" + std::to_string(name);
        if ((i + static_cast<std::size_t>(n / names)) % 2 == 0) {
          if (request(port(), "POST", "/v1/streams", R"({"name":")" + stream + R"("})", json_type).status == 201)
            ++there.at(static_cast<std::size_t>(name));
        } else if (request(port(), "DELETE", "/v1/streams/" + stream).status == 204) {
          --there.at(static_cast<std::size_t>(name));
        }
      }
    });
  for (auto& thread : threads) thread.join();
  for (const bool restarted : {false, true}) {
    if (restarted) {
      EXPECT_EQ(server_->end(SIGKILL), -SIGKILL);
      server_ = std::make_unique<ServerProcess>(folder_.path() / "data");
    }
    for (int name = 0; name < names; ++name) {
      const auto status = request(port(), "GET", "/v1/streams/race-" + std::to_string(name)).status;
      EXPECT_EQ(status == 200 ? 1 : 0, there.at(static_cast<std::size_t>(name)))
          << name << (restarted ? ", restarted" : "");
    }
  }
}

TEST_F(Idempotency, RecordingsThatBeginWhileTheirStreamIsRemoved_End) {
  for (int round = 0; round < 20; ++round) {
    ASSERT_EQ(request(port(), "POST", "/v1/streams", R"({"name":"short"})", json_type).status, 201);
    std::barrier together(4);
    std::vector<std::thread> threads;
    for (int i = 0; i < 4; ++i)
      threads.emplace_back([&, i] {
        together.arrive_and_wait();
        if (i == 0)
          request(port(), "DELETE", "/v1/streams/short");
        else
          request(port(), "POST", "/v1/streams/short/recordings", "{}", json_type);
      });
    for (auto& thread : threads) thread.join();
    ASSERT_EQ(request(port(), "GET", "/v1/streams/short").status, 404);
    EXPECT_TRUE(testing::eventually([&] {
      const auto list = json_of(request(port(), "GET", "/v1/recordings?limit=200"))["recordings"];
      return std::none_of(list.begin(), list.end(), [](const json& one) { return one["state"] == "recording"; });
    })) << "one goes on for a stream that is gone";
  }
}

TEST_F(Idempotency, OtherBodies_AreRefused) {
  for (int round = 0; round < rounds; ++round) {
    std::vector<Call> calls;
    for (std::size_t i = 0; i < connections; ++i)
      calls.push_back({"/v1/models?filename=a.obj", grid_obj(i % 2 == 0 ? 4 : 5), "model/obj"});
    const auto replies = at_once(port(), calls, {"key" + std::to_string(round)});
    std::set<std::string> made;
    std::array<std::set<int>, 2> statuses;
    for (std::size_t i = 0; i < replies.size(); ++i) {
      statuses.at(i % 2).insert(replies[i].status);
      if (replies[i].status == 202) made.insert(id_in(replies[i]));
    }
    EXPECT_EQ(made.size(), 1U);
    EXPECT_TRUE((statuses[0] == std::set{202} && statuses[1] == std::set{422}) ||
                (statuses[0] == std::set{422} && statuses[1] == std::set{202}));
  }
}

}  // namespace
}  // namespace semblante::test
