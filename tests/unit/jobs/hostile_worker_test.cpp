// Workers that a model took over, run by the queue: the job fails with the reason, and the next one is done.
#include <condition_variable>
#include <cstdlib>
#include <mutex>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "server/jobs/job_queue.h"
#include "server/store/sqlite_store.h"
#include "tests/support/wait.h"
#include "tests/unit/jobs/sanitized.h"

namespace semblante::jobs {
namespace {

using ::testing::HasSubstr;

constexpr std::string_view triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

class HostileWorkerTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (testing::is_sanitized) GTEST_SKIP() << "workers are not isolated in a build with a sanitizer";
    std::string name = (std::filesystem::temp_directory_path() / "semblante-hostile-XXXXXX").string();
    folder_ = mkdtemp(name.data());
    store_ = *store::open_sqlite_store(folder_ / "facts.sqlite");
    blobs_ = std::make_unique<store::BlobStore>(store::BlobStore::open(folder_));
    pending_ = std::make_unique<store::PendingWrites>(store::PendingWrites::Options{});
    config_.limits = {std::uint64_t{512} << 20U, 60, std::uint64_t{1} << 20U};
  }
  void TearDown() override {
    if (!folder_.empty()) std::filesystem::remove_all(folder_);
  }

  /// The job, an import of a triangle, after its end.
  store::JobRecord end_of_import(const std::string& deed) {
    config_.worker_command = {SEMBLANTE_HOSTILE_WORKER, deed};
    const auto job = new_record(ImportJob{}, "model-" + std::to_string(++count_));
    const auto blob = blobs_->put(triangle);
    store::ModelRecord model;
    model.id = model.name = job.model;
    model.file_name = "triangle.obj";
    model.created = model.updated = job.created;
    model.source_sha256 = blob->sha256;
    model.source_bytes = blob->bytes;
    store_->create_model(model, {"source", blob->sha256, blob->bytes, ""}, job, std::nullopt);
    JobQueue queue({*store_, *store_, *store_}, *blobs_, *pending_, config_);
    std::mutex mutex;
    std::condition_variable changed;
    bool has_ended = false;
    queue.on_finished([&](const store::JobRecord&) {
      const std::lock_guard lock(mutex);
      has_ended = true;
      changed.notify_all();
    });
    queue.start();
    std::unique_lock lock(mutex);
    EXPECT_TRUE(changed.wait_for(lock, testing::patience, [&] { return has_ended; })) << deed;
    lock.unlock();
    return queue.find(job.id).value();
  }
  std::string failure_of(const std::string& deed) {
    const auto job = end_of_import(deed);
    EXPECT_EQ(job.state, store::JobState::failed) << deed;
    EXPECT_TRUE(std::filesystem::is_empty(blobs_->temporary())) << deed;
    return job.problem;
  }

  std::filesystem::path folder_;
  std::unique_ptr<store::Store> store_;
  std::unique_ptr<store::BlobStore> blobs_;
  std::unique_ptr<store::PendingWrites> pending_;
  JobConfig config_;
  int count_ = 0;
};

TEST_F(HostileWorkerTest, Work_IsDone) { EXPECT_EQ(end_of_import("work").state, store::JobState::done); }

TEST_F(HostileWorkerTest, ForbiddenCalls_EndTheWorker_AndTheNextJobIsDone) {
  for (const char* const deed : {"socket", "fork", "exec", "ptrace"}) {
    const auto problem = failure_of(deed);
    EXPECT_THAT(problem, HasSubstr("worker-crashed")) << deed;
    EXPECT_THAT(problem, HasSubstr("SIGSYS")) << deed;
  }
  EXPECT_EQ(end_of_import("work").state, store::JobState::done);
}

TEST_F(HostileWorkerTest, FilesOfOthers_AreNotRead) {
  const auto other = blobs_->put("the head of somebody else");
  for (const auto& path : {std::string("/etc/passwd"), blobs_->find(other->sha256)->string(),
                           (folder_ / "facts.sqlite").string(), std::string("/proc/self/environ")})
    EXPECT_THAT(failure_of(path), HasSubstr("it read 0 bytes")) << path;
}

TEST_F(HostileWorkerTest, CrashAndAbort_AreNamed) {
  EXPECT_THAT(failure_of("crash"), HasSubstr("signal 11 (SEGV)"));
  EXPECT_THAT(failure_of("abort"), HasSubstr("signal 6 (ABRT)"));
  EXPECT_EQ(end_of_import("work").state, store::JobState::done);
}

TEST_F(HostileWorkerTest, HangAndBomb_MeetTheLimits) {
  EXPECT_THAT(failure_of("bomb"), HasSubstr("needs more memory than a job is given"));
  config_.limits.cpu_seconds = 1;
  EXPECT_THAT(failure_of("hang"), HasSubstr("1 s of processor time"));
  config_.limits.cpu_seconds = 60;
  config_.wall_limit = std::chrono::seconds(1);
  EXPECT_THAT(failure_of("hang"), HasSubstr("took longer than 1 s"));
  config_.wall_limit = testing::patience;
  EXPECT_EQ(end_of_import("work").state, store::JobState::done);
}

}  // namespace
}  // namespace semblante::jobs
