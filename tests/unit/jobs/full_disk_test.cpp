// A full disk while jobs wait, run, end and are cancelled: each reaches its end when there is room, none is shown as
// ended before this is durable, and none is lost.
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <sqlite3.h>

#include <gtest/gtest.h>

#include "server/jobs/job_queue.h"
#include "server/store/sqlite_store.h"
#include "tests/support/failing_database.h"
#include "tests/support/wait.h"

namespace semblante::jobs {
namespace {

using std::chrono::milliseconds;
using store::JobState;
using test::fail_database_writes;

class FullDiskQueueTest : public ::testing::Test {
 protected:
  FullDiskQueueTest() {
    fail_database_writes(SQLITE_OK);
    std::string name = (std::filesystem::temp_directory_path() / "semblante-queue-XXXXXX").string();
    folder_ = mkdtemp(name.data());
    store_ = *store::open_sqlite_store(folder_ / "facts.sqlite");
    blobs_ = std::make_unique<store::BlobStore>(store::BlobStore::open(folder_));
    options_.first_delay = milliseconds(1);
    options_.longest_delay = milliseconds(5);
    options_.probe = [this] { store_->check_writable(); };
    // Says that it runs, and ends when it may: without a result, unless `result` says otherwise.
    config_.worker_command = {"/bin/sh", "-c",
                              "cd " + folder_.string() +
                                  "; cat > /dev/null; echo run >> runs; until [ -e go ]; do sleep 0.02; done; "
                                  "[ -e result ] && cat result"};
    begin();
  }
  ~FullDiskQueueTest() override {
    fail_database_writes(SQLITE_OK);
    queue_.reset();
    pending_.reset();
    std::filesystem::remove_all(folder_);
  }

  void begin() {
    pending_ = std::make_unique<store::PendingWrites>(options_);
    queue_ = std::make_unique<JobQueue>(JobStores{*store_, *store_, *store_}, *blobs_, *pending_, config_);
    queue_->on_finished([this](const store::JobRecord& job) {
      const std::lock_guard lock(mutex_);
      ended_.push_back({job, store_->job(job.id)});
    });
  }
  void restart() {
    queue_.reset();
    pending_.reset();
    begin();
    queue_->start();
  }

  /// The database can be written again: the jobs end as what they were told to be.
  void expect_cancelled_with_room(std::initializer_list<const char*> jobs) {
    fail_database_writes(SQLITE_OK);
    for (const char* job : jobs) ASSERT_TRUE(wait_for_end(job)) << job;
    for (const char* job : jobs) EXPECT_EQ(store_->job(job)->state, JobState::cancelled) << job;
  }

  store::JobRecord add_job(const std::string& id) {
    store::JobRecord job;
    job.id = id;
    job.kind = ImportJob::kind_name;
    job.model = id;
    job.created = job.updated = store::timestamp_now();
    const auto blob = blobs_->put(id);
    store::ModelRecord model;
    model.id = model.name = id;
    model.created = model.updated = job.created;
    model.source_sha256 = blob->sha256;
    model.source_bytes = blob->bytes;
    store_->create_model(model, {"source", blob->sha256, blob->bytes, ""}, job, std::nullopt);
    return job;
  }
  void allow_end() { std::ofstream(folder_ / "go") << "go"; }
  std::size_t runs() const {
    std::ifstream file(folder_ / "runs");
    std::size_t lines = 0;
    for (std::string line; std::getline(file, line);) ++lines;
    return lines;
  }
  bool wait_for_end(const std::string& id) {
    return testing::eventually([&] { return store::is_final(queue_->find(id)->state); });
  }
  bool wait_until_pending() {
    return testing::eventually([&] { return pending_->status().count > 0; });
  }
  std::size_t ended() {
    const std::lock_guard lock(mutex_);
    return ended_.size();
  }

  std::filesystem::path folder_;
  std::unique_ptr<store::Store> store_;
  std::unique_ptr<store::BlobStore> blobs_;
  store::PendingWrites::Options options_;
  JobConfig config_;
  std::unique_ptr<store::PendingWrites> pending_;
  std::unique_ptr<JobQueue> queue_;
  std::mutex mutex_;
  std::vector<std::pair<store::JobRecord, std::optional<store::JobRecord>>> ended_;  ///< as said, as stored then
};

TEST_F(FullDiskQueueTest, JobThatCannotBegin_WaitsForRoom) {
  queue_->start();
  const auto job = add_job("a");
  fail_database_writes(SQLITE_FULL);
  queue_->enqueue(job);
  ASSERT_TRUE(wait_until_pending());
  EXPECT_EQ(queue_->find("a")->state, JobState::queued);
  EXPECT_EQ(queue_->find("a")->stage, "waiting for disk space");
  EXPECT_EQ(queue_->waiting(), 1U);
  EXPECT_EQ(runs(), 0U) << "no worker is started for nothing";
  allow_end();
  fail_database_writes(SQLITE_OK);
  ASSERT_TRUE(wait_for_end("a"));
  EXPECT_EQ(runs(), 1U);
  EXPECT_EQ(store_->job("a")->attempts, 1U) << "waiting is no attempt";
}

TEST_F(FullDiskQueueTest, EndThatCannotBeRecorded_IsNotShown_AndIsRecordedWithRoom) {
  queue_->start();
  queue_->enqueue(add_job("a"));
  ASSERT_TRUE(testing::eventually([&] { return runs() == 1; }));
  fail_database_writes(SQLITE_FULL);
  allow_end();
  ASSERT_TRUE(wait_until_pending());
  EXPECT_EQ(queue_->find("a")->state, JobState::running);
  EXPECT_EQ(queue_->find("a")->stage, "saving");
  EXPECT_EQ(store_->model("a")->state, store::ModelState::importing);
  EXPECT_EQ(ended(), 0U);
  EXPECT_EQ(pending_->status().what, std::vector<std::string>{"the end of job a"});
  fail_database_writes(SQLITE_OK);
  ASSERT_TRUE(testing::eventually([&] { return ended() == 1; }));
  EXPECT_EQ(ended_[0].first.state, JobState::failed);
  EXPECT_EQ(ended_[0].second->state, JobState::failed) << "durable before anybody hears of it";
  EXPECT_EQ(store_->model("a")->state, store::ModelState::failed);
  EXPECT_EQ(queue_->ended(ImportJob::kind_name, JobState::failed), 1U);
}

TEST_F(FullDiskQueueTest, ResultThatCannotBeCommitted_IsMadeAgainWithRoom) {
  queue_->start();
  queue_->enqueue(add_job("a"));
  ASSERT_TRUE(testing::eventually([&] { return runs() == 1; }));
  std::ofstream(folder_ / "result") << to_json_line(WorkerResult{ImportJob::Outcome{}, {}});
  fail_database_writes(SQLITE_FULL);
  allow_end();
  ASSERT_TRUE(wait_until_pending());
  EXPECT_EQ(queue_->find("a")->state, JobState::queued);
  EXPECT_EQ(store_->model("a")->state, store::ModelState::importing);
  fail_database_writes(SQLITE_OK);
  ASSERT_TRUE(wait_for_end("a"));
  EXPECT_EQ(queue_->find("a")->state, JobState::done);
  EXPECT_EQ(store_->model("a")->state, store::ModelState::ready);
  EXPECT_EQ(runs(), 2U);
}

TEST_F(FullDiskQueueTest, OutcomeOfAnotherKindOfJob_FailsTheJob) {
  std::ofstream(folder_ / "result") << to_json_line(WorkerResult{ProposeJob::Outcome{}, {}});
  allow_end();
  queue_->start();
  queue_->enqueue(add_job("a"));
  ASSERT_TRUE(wait_for_end("a"));
  EXPECT_EQ(queue_->find("a")->state, JobState::failed);
  EXPECT_EQ(http::problem_from_json(queue_->find("a")->problem).slug, "internal");
  EXPECT_EQ(store_->model("a")->state, store::ModelState::failed);
}

TEST_F(FullDiskQueueTest, DiskFullAgainAndAgain_FailsTheJobInTheEnd) {
  // A worker that finds no room, while the store has some.
  std::ofstream(folder_ / "result") << to_json_line(
      http::make_problem("insufficient-storage", "positions: No space left on device"));
  allow_end();
  queue_->start();
  queue_->enqueue(add_job("a"));
  ASSERT_TRUE(wait_for_end("a"));
  EXPECT_EQ(runs(), config_.max_attempts);
  const auto job = queue_->find("a");
  EXPECT_EQ(job->state, JobState::failed);
  EXPECT_EQ(http::problem_from_json(job->problem).slug, "insufficient-storage");
  EXPECT_EQ(store_->model("a")->state, store::ModelState::failed);
}

TEST_F(FullDiskQueueTest, Cancel_TakesEffect_AndIsRecordedWithRoom) {
  queue_->start();
  queue_->enqueue(add_job("runs"));
  queue_->enqueue(add_job("waits"));
  ASSERT_TRUE(testing::eventually([&] { return runs() == 1; }));
  fail_database_writes(SQLITE_FULL);
  EXPECT_EQ(queue_->cancel("waits"), Cancelled::pending);
  EXPECT_EQ(queue_->cancel("runs"), Cancelled::pending);
  EXPECT_EQ(queue_->find("waits")->state, JobState::queued) << "it is not cancelled before this is durable";
  ASSERT_TRUE(testing::eventually([&] { return queue_->running() == 0; })) << "its worker is gone";
  EXPECT_FALSE(store::is_final(queue_->find("runs")->state));
  expect_cancelled_with_room({"runs", "waits"});
  EXPECT_EQ(runs(), 1U);
}

TEST_F(FullDiskQueueTest, CancelOfAJobThatWaitsForRoom) {
  queue_->start();
  const auto job = add_job("a");
  fail_database_writes(SQLITE_FULL);
  queue_->enqueue(job);
  ASSERT_TRUE(wait_until_pending());
  EXPECT_EQ(queue_->cancel("a"), Cancelled::pending);
  expect_cancelled_with_room({"a"});
  EXPECT_EQ(runs(), 0U);
}

TEST_F(FullDiskQueueTest, CancelOfARunningJob_IsDurableWhenItIsAcknowledged) {
  queue_->start();
  queue_->enqueue(add_job("a"));
  ASSERT_TRUE(testing::eventually([&] { return runs() == 1; }));
  EXPECT_EQ(queue_->cancel("a"), Cancelled::recorded);
  EXPECT_EQ(queue_->cancel("absent"), Cancelled::none);
  const auto stored = store_->job("a");
  EXPECT_TRUE(store::is_final(stored->state) || stored->stage == store::cancelling_stage);
  ASSERT_TRUE(wait_for_end("a"));
  EXPECT_EQ(queue_->cancel("a"), Cancelled::none) << "it has ended";
}

TEST_F(FullDiskQueueTest, CancelThatOutlivedItsServer_IsNotTakenUpAgain) {
  add_job("a");
  ASSERT_TRUE(store_->request_cancel("a"));
  allow_end();
  queue_->start();
  ASSERT_TRUE(wait_for_end("a"));
  EXPECT_EQ(store_->job("a")->state, JobState::cancelled);
  EXPECT_EQ(runs(), 0U);
}

TEST_F(FullDiskQueueTest, RemovalOfAModelThatFails_LeavesNoJobBehind) {
  queue_->start();
  queue_->enqueue(add_job("other"));
  queue_->enqueue(add_job("a"));
  ASSERT_TRUE(testing::eventually([&] { return runs() == 1; }));
  fail_database_writes(SQLITE_FULL);
  queue_->cancel_all_of("a");
  EXPECT_THROW(store_->remove_model("a"), store::DiskFull);
  expect_cancelled_with_room({"a"});  // its model is still there, and so is its job
}

TEST_F(FullDiskQueueTest, StartsOnAFullDisk_AndTakesUpItsJobsWithRoom) {
  for (const std::string id : {"a", "b"}) {
    auto cut_off = add_job(id);
    cut_off.state = JobState::running;
    cut_off.stage = "reading";
    store_->update_job(cut_off);
  }
  auto worn_out = add_job("c");
  worn_out.attempts = config_.max_attempts;
  store_->update_job(worn_out);
  allow_end();
  fail_database_writes(SQLITE_FULL);
  queue_->start();
  EXPECT_EQ(pending_->status().count, 3U);
  EXPECT_EQ(queue_->find("c")->state, JobState::queued) << "that it failed is not durable yet";
  fail_database_writes(SQLITE_OK);
  for (const std::string id : {"a", "b", "c"}) ASSERT_TRUE(wait_for_end(id)) << id;
  EXPECT_EQ(runs(), 2U);
  EXPECT_EQ(http::problem_from_json(store_->job("c")->problem).slug, "worker-crashed");
  EXPECT_TRUE(testing::eventually([&] { return pending_->status().writable; }));
}

TEST_F(FullDiskQueueTest, StopOnAFullDisk_LeavesTheRestToTheNextStart) {
  queue_->start();
  queue_->enqueue(add_job("a"));
  ASSERT_TRUE(testing::eventually([&] { return runs() == 1; }));
  fail_database_writes(SQLITE_FULL);
  allow_end();
  ASSERT_TRUE(wait_until_pending());
  queue_->stop();
  EXPECT_EQ(pending_->status().count, 0U);
  fail_database_writes(SQLITE_OK);
  EXPECT_EQ(store_->job("a")->state, JobState::running);
  restart();
  ASSERT_TRUE(wait_for_end("a"));
  EXPECT_EQ(runs(), 2U);
}

TEST_F(FullDiskQueueTest, FaultAfterTheEnd_DoesNotEndTheProcess) {
  queue_->on_finished([](const store::JobRecord&) { throw store::DiskFull("full"); });
  allow_end();
  queue_->start();
  queue_->enqueue(add_job("a"));
  ASSERT_TRUE(wait_for_end("a"));
  queue_->enqueue(add_job("b"));
  EXPECT_TRUE(wait_for_end("b")) << "and the queue goes on";
}

}  // namespace
}  // namespace semblante::jobs
