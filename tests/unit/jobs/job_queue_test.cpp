#include "server/jobs/job_queue.h"

#include <cstdlib>

#include <gtest/gtest.h>

#include "server/store/sqlite_store.h"
#include "tests/support/wait.h"

namespace semblante::jobs {
namespace {

class JobQueueTest : public ::testing::Test {
 protected:
  JobQueueTest() {
    std::string name = (std::filesystem::temp_directory_path() / "semblante-queue-XXXXXX").string();
    folder_ = mkdtemp(name.data());
    store_ = *store::open_sqlite_store(folder_ / "facts.sqlite");
    blobs_ = std::make_unique<store::BlobStore>(store::BlobStore::open(folder_));
  }
  ~JobQueueTest() override { std::filesystem::remove_all(folder_); }

  store::JobRecord add_job(const std::string& id, const std::string& model) {
    store::JobRecord job;
    job.id = id;
    job.model = model;
    job.kind = ParametrizeJob::kind_name;
    job.request = new_record(ParametrizeJob{}, model).request;
    job.created = job.updated = store::timestamp_now();
    if (!store_->model(model)) {
      const auto blob = blobs_->put(model);
      store::ModelRecord record;
      record.id = record.name = model;
      record.created = record.updated = job.created;
      record.source_sha256 = blob->sha256;
      record.source_bytes = blob->bytes;
      store_->create_model(record, {"source", blob->sha256, blob->bytes, ""}, job, std::nullopt);
    } else {
      store_->create_job(job, {}, std::nullopt);
    }
    return job;
  }

  std::filesystem::path folder_;
  std::unique_ptr<store::Store> store_;
  std::unique_ptr<store::BlobStore> blobs_;
};

TEST_F(JobQueueTest, JobsOfOneModel_RunOneAfterTheOther) {
  // A worker that holds a lock of its model for a while, and notes who finds it taken.
  const std::string script = "cd " + folder_.string() +
                             R"(
request=$(cat)
case "$request" in *'"name":"a"'*) lock=lock-a;; *) lock=lock-b;; esac
mkdir $lock || touch overlap
sleep 0.2
rmdir $lock
echo $lock >> done)";
  JobConfig config;
  config.worker_command = {"/bin/sh", "-c", script};
  config.concurrency = 3;
  std::vector<store::JobRecord> jobs;
  for (int round = 0; round < 3; ++round) {
    for (const std::string model : {"a", "b"}) jobs.push_back(add_job(model + std::to_string(round), model));
  }
  store::PendingWrites pending{{}};
  JobQueue queue({*store_, *store_, *store_}, *blobs_, pending, config);
  std::mutex mutex;
  std::condition_variable ended;
  std::size_t count = 0;
  queue.on_finished([&](const store::JobRecord&) {
    const std::lock_guard lock(mutex);
    ++count;
    ended.notify_all();
  });
  queue.start();
  std::unique_lock lock(mutex);
  ASSERT_TRUE(ended.wait_for(lock, testing::patience, [&] { return count == jobs.size(); }));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "overlap"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "done")) << "the worker did not run at all";
  for (const auto& job : jobs) EXPECT_EQ(queue.find(job.id)->state, store::JobState::failed) << "it gave no result";
}

}  // namespace
}  // namespace semblante::jobs
