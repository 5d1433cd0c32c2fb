// One Idempotency-Key in many requests at the same moment, on every route that takes it: one of them creates, the
// others get its answer.

#include <atomic>
#include <barrier>
#include <cstdlib>
#include <fstream>
#include <set>
#include <thread>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "server/api/api.h"
#include "server/store/sqlite_store.h"
#include "tests/support/api_exchange.h"

namespace semblante::api {
namespace {

using nlohmann::json;

constexpr int thread_count = 8;
constexpr int rounds = 25;

struct Answer {
  int status = 0;
  std::string location, body, fault;
  [[nodiscard]] std::string type() const { return json::parse(body).value("type", ""); }
};

class IdempotencyTest : public ::testing::Test {
 protected:
  IdempotencyTest() {
    std::string name = (std::filesystem::temp_directory_path() / "semblante-api-XXXXXX").string();
    folder_ = mkdtemp(name.data());
    store_ = *store::open_sqlite_store(folder_ / "facts.sqlite");
    blobs_ = std::make_unique<store::BlobStore>(store::BlobStore::open(folder_));
    jobs::JobConfig jobs;
    jobs.max_queued = 100'000;
    jobs_ = std::make_unique<jobs::JobQueue>(jobs::JobStores{*store_, *store_, *store_}, *blobs_, pending_,
                                             jobs);  // not started: jobs stay queued
    recordings::RecorderLimits limits;
    limits.disk_reserve = 0;
    recorder_ = recordings::Recorder::open(*store_, *store_, pending_, folder_ / "recordings", limits);
    ApiConfig config;
    config.limits.max_models = config.limits.max_streams = config.limits.max_expressions = 100'000;
    api_ = std::make_unique<Api>(Context{*store_, *blobs_, pending_, *jobs_, hub_, config, {}, recorder_});
    add_model();
    EXPECT_EQ(handle("POST", "/v1/streams", R"({"name":"recorded"})", "").status, 201);
  }
  ~IdempotencyTest() override {
    recorder_->close();
    std::filesystem::remove_all(folder_);
  }

  /// An imported model with enough points for every route.
  void add_model() {
    store::ModelRecord model;
    model.id = model.name = "head";
    model.created = model.updated = store::timestamp_now();
    store::JobRecord job;
    job.id = "import";
    job.model = model.id;
    job.created = job.updated = model.created;
    store_->create_model(model, {"source", std::string(64, 'a'), 1, ""}, job, std::nullopt);
    model.format = "obj";
    model.vertices = 100;
    model.morph_targets = {{"smile", 5}};
    job.state = store::JobState::done;
    store_->finish_import(job, model, {}, std::nullopt);
    std::vector<store::FeaturePointRecord> points;
    std::uint32_t vertex = 0;
    for (const char* id :
         {"2.1", "2.2", "2.3", "2.4", "2.5",  "3.7",  "3.8",  "3.9", "3.10", "3.11", "3.12", "4.1", "4.2",
          "5.1", "5.2", "8.1", "9.3", "10.1", "10.2", "11.1", "9.1", "9.2",  "9.15", "11.4", "7.1"})
      points.push_back({id, vertex++, std::nullopt});
    EXPECT_TRUE(store_->put_feature_points("head", points, 0));
  }

  Answer handle(const std::string& method, const std::string& path, const std::string& body, const std::string& key,
                bool as_file = false) {
    static std::atomic<int> number{0};
    http::Request request;
    request.method = method;
    request.path = path;
    if (!key.empty()) request.headers["Idempotency-Key"] = key;
    if (as_file) {
      request.body_file = std::make_shared<http::TemporaryFile>(blobs_->temporary() / std::to_string(number++));
      std::ofstream(request.body_file->path(), std::ios::binary) << body;
    } else {
      request.body = body;
    }
    Answer answer;
    test::ApiExchange exchange{method, path, "", as_file ? "" : body, 500, "", ""};
    try {
      api_->find_route(request);
      const auto response = api_->handle(request);
      answer.status = response.status;
      if (const auto found = response.headers.find("Location"); found != response.headers.end())
        answer.location = found->second;
      if (const auto* text = std::get_if<std::string>(&response.body)) answer.body = *text;
      exchange.status = response.status;
      if (const auto found = response.headers.find("Content-Type"); found != response.headers.end())
        exchange.type = found->second;
      exchange.body = answer.body;
      for (const auto& fault : test::exchange_faults(exchange))
        ADD_FAILURE() << method << " " << path << " is answered " << answer.status
                      << ", against openapi.json: " << fault;
    } catch (const std::exception& fault) {  // the network layer makes a 500 of it
      answer.status = 500;
      answer.fault = fault.what();
    }
    return answer;
  }

  /// All threads do the same at the same moment.
  static std::vector<Answer> at_once(const std::function<Answer(int thread)>& act) {
    std::vector<Answer> answers(thread_count);
    std::barrier together(thread_count);
    std::vector<std::thread> threads;
    for (int i = 0; i < thread_count; ++i)
      threads.emplace_back([&, i] {
        together.arrive_and_wait();
        answers[static_cast<std::size_t>(i)] = act(i);
      });
    for (auto& thread : threads) thread.join();
    return answers;
  }

  /// `count` is what one creation raises by one.
  void expect_one(const std::string& path, const std::function<std::string(int round)>& body, int status,
                  const std::function<std::size_t()>& count, bool as_file = false) {
    for (int round = 0; round < rounds; ++round) {
      const auto key = path + std::to_string(round);
      const auto before = count();
      const auto answers = at_once([&](int) { return handle("POST", path, body(round), key, as_file); });
      ASSERT_EQ(count(), before + 1);
      for (const auto& answer : answers) {
        ASSERT_EQ(answer.status, status) << answer.body << answer.fault;
        ASSERT_EQ(answer.location, answers[0].location);
        ASSERT_EQ(answer.body, answers[0].body);
      }
      ASSERT_EQ(handle("POST", path, body(round), key, as_file).body, answers[0].body) << "as a retry does";
    }
  }

  std::filesystem::path folder_;
  std::unique_ptr<store::Store> store_;
  std::unique_ptr<store::BlobStore> blobs_;
  store::PendingWrites pending_{{}};
  std::unique_ptr<jobs::JobQueue> jobs_;
  streams::InProcessHub hub_;
  std::shared_ptr<recordings::Recorder> recorder_;
  std::unique_ptr<Api> api_;
};

TEST_F(IdempotencyTest, Models_OneIsMade) {
  const auto obj = [](int round) { return "v 0 0 0\nv 1 0 0\nv 0 1 " + std::to_string(round) + "\nf 1 2 3\n"; };
  expect_one(
      "/v1/models", obj, 202, [&] { return store_->model_count(); }, true);
}

TEST_F(IdempotencyTest, Parametrizations_OneIsMade) {
  expect_one(
      "/v1/models/head/parametrizations", [](int) { return "{}"; }, 202, [&] { return jobs_->waiting(); });
}

TEST_F(IdempotencyTest, Proposals_OneIsMade) {
  expect_one(
      "/v1/models/head/feature-points/proposals", [](int) { return ""; }, 202, [&] { return jobs_->waiting(); });
}

TEST_F(IdempotencyTest, Extractions_OneIsMade) {
  expect_one(
      "/v1/expressions", [](int) { return R"({"model":"head","target":"smile"})"; }, 202,
      [&] { return jobs_->waiting(); });
}

TEST_F(IdempotencyTest, ExpressionsByHand_OneIsMade) {
  expect_one(
      "/v1/expressions", [](int) { return R"({"name":"Grin","displacements":{}})"; }, 201,
      [&] { return store_->set_count(); });
}

TEST_F(IdempotencyTest, Streams_OneIsMade) {
  expect_one(
      "/v1/streams", [](int round) { return R"({"name":"s)" + std::to_string(round) + "\"}"; }, 201,
      [&] { return hub_.list().size(); });
}

TEST_F(IdempotencyTest, StreamsWithoutName_OneIsMade) {
  expect_one(
      "/v1/streams", [](int) { return "{}"; }, 201, [&] { return store_->streams().size(); });
}

TEST_F(IdempotencyTest, Recordings_OneIsMade) {
  expect_one(
      "/v1/streams/recorded/recordings", [](int) { return "{}"; }, 201, [&] { return store_->recording_count(); });
}

TEST_F(IdempotencyTest, LastPlace_IsForAllOfTheKey) {
  ApiConfig config;
  for (int round = 0; round < rounds; ++round) {
    config.limits.max_streams = hub_.list().size() + 1;
    api_ = std::make_unique<Api>(Context{*store_, *blobs_, pending_, *jobs_, hub_, config, {}, recorder_});
    const auto answers = at_once([&](int) { return handle("POST", "/v1/streams", "{}", std::to_string(round)); });
    for (const auto& answer : answers) {
      ASSERT_EQ(answer.status, 201) << answer.body << answer.fault;
      ASSERT_EQ(answer.location, answers[0].location);
    }
  }
}

TEST_F(IdempotencyTest, OtherBodies_AreRefused_WhicheverIsFirst) {
  for (int round = 0; round < rounds; ++round) {
    const auto answers = at_once([&](int thread) {
      return handle("POST", "/v1/streams", thread % 2 == 0 ? R"({"title":"a"})" : R"({"title":"b"})",
                    std::to_string(round));
    });
    std::set<std::string> made;
    std::array<int, 2> made_by{};
    for (std::size_t i = 0; i < answers.size(); ++i) {
      if (answers[i].status == 201) {
        made.insert(answers[i].location);
        ++made_by.at(i % 2);
      } else {
        ASSERT_EQ(answers[i].status, 422) << answers[i].body << answers[i].fault;
        ASSERT_EQ(answers[i].type(), "/problems/idempotency-key-reused");
      }
    }
    ASSERT_EQ(made.size(), 1U);
    ASSERT_EQ(made_by[0] + made_by[1], thread_count / 2);
    ASSERT_TRUE(made_by[0] == 0 || made_by[1] == 0);
    ASSERT_EQ(store_->streams().size(), static_cast<std::size_t>(round) + 2);
  }
}

TEST_F(IdempotencyTest, OtherKeys_MeetARealConflict) {
  for (int round = 0; round < rounds; ++round) {
    const auto number = std::to_string(round);
    const auto answers = at_once([&](int thread) {
      return handle("POST", "/v1/streams", R"({"name":"same)" + number + "\"}", number + "-" + std::to_string(thread));
    });
    int made = 0;
    for (const auto& answer : answers) {
      if (answer.status == 201)
        ++made;
      else
        ASSERT_EQ(answer.status, 409) << answer.body << answer.fault;
    }
    ASSERT_EQ(made, 1);
  }
}

TEST_F(IdempotencyTest, Failures_AreNotRemembered_AndTheNextOneTries) {
  for (int round = 0; round < rounds; ++round) {
    const auto number = std::to_string(round);
    const auto name = "taken" + number;
    const auto body = R"({"name":")" + name + "\"}";
    ASSERT_EQ(handle("POST", "/v1/streams", body, "").status, 201);
    // One of them makes room while the others ask.
    const auto answers = at_once([&](int thread) {
      return thread == 0 ? handle("DELETE", "/v1/streams/" + name, "", "")
                         : handle("POST", "/v1/streams", body, number);
    });
    for (std::size_t i = 1; i < answers.size(); ++i)
      ASSERT_TRUE(answers[i].status == 201 || answers[i].status == 409) << answers[i].body << answers[i].fault;
    ASSERT_EQ(handle("POST", "/v1/streams", body, number).status, 201) << "nobody else has the name now";
    ASSERT_EQ(handle("POST", "/v1/streams", body, number).status, 201);
  }
}

}  // namespace
}  // namespace semblante::api
