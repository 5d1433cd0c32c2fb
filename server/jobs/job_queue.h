#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "server/jobs/worker_process.h"
#include "server/jobs/worker_protocol.h"
#include "server/store/blob_store.h"
#include "server/store/store.h"

namespace semblante::jobs {

struct JobConfig {
  std::vector<std::string> worker_command;  ///< program and arguments; the limits are added
  WorkerLimits limits;
  std::chrono::seconds wall_limit{900};
  unsigned concurrency = 1;     ///< workers at a time
  std::size_t max_queued = 64;  ///< waiting jobs; more are answered 429
  std::uint32_t max_attempts = 3;
};

/// Takes jobs in order, each in a worker process, and writes what became of them into the store. Jobs of one model
/// never run at the same time. Owns its threads; store and blobs outlive it. All calls from any thread but the I/O
/// threads.
class JobQueue {
 public:
  using Watcher = std::function<void(const store::JobRecord&)>;

  JobQueue(store::Store& store, store::BlobStore& blobs, JobConfig config);
  ~JobQueue();
  JobQueue(const JobQueue&) = delete;
  JobQueue& operator=(const JobQueue&) = delete;

  /// Takes up again what an earlier process left unfinished, then begins to work.
  void start();
  /// Kills the workers; their jobs stay unfinished in the store, for the next start.
  void stop();

  /// False when as many wait as may.
  [[nodiscard]] bool has_room() const;
  /// A job that is in the store already.
  void enqueue(const store::JobRecord& job);
  /// False when there is no such job or it has ended. A queued one ends at once, a running one within seconds.
  bool cancel(std::string_view id);
  /// Ends the jobs of a model that is about to be removed; returns when none runs any more.
  void cancel_all_of(std::string_view model);

  /// The job as it is now; progress is newer here than in the store.
  [[nodiscard]] std::optional<store::JobRecord> find(std::string_view id) const;
  /// Calls `watcher` at every change of the job from now on, from the queue's threads. Pair with unwatch().
  std::uint64_t watch(std::string_view id, Watcher watcher);
  /// After this the watcher is not called any more.
  void unwatch(std::uint64_t watch);
  /// Called after the end of every job, from the queue's threads. Before start().
  void on_finished(Watcher watcher) { on_finished_ = std::move(watcher); }

  [[nodiscard]] std::size_t waiting() const;
  [[nodiscard]] std::size_t running() const;
  /// How many jobs of a kind have ended so (done, failed, cancelled) since the queue was made.
  [[nodiscard]] std::uint64_t ended(store::JobKind kind, store::JobState state) const;

 private:
  struct Running {
    store::JobRecord job;
    std::atomic<bool> cancel{false};
  };

  void work();
  /// The first job that may begin: those of one model run one after the other, each on what the one before it left.
  std::deque<store::JobRecord>::iterator next();
  void run(const std::shared_ptr<Running>& running);
  void finish(const std::shared_ptr<Running>& running, const WorkerRequest& request,
              std::optional<WorkerLine> last_line, const Result<WorkerExit>& exit);
  void finish_with_result(store::JobRecord& job, const WorkerRequest& request, WorkerResult result);
  void remove_orphans(const std::optional<std::vector<std::string>>& hashes) const;
  /// The end of an extraction: the set, and its files no more.
  void finish_extraction(store::JobRecord& job, const WorkerResult& result);
  void release_files(const store::JobRecord& job);
  void fail(store::JobRecord& job, store::JobState state, const http::Problem& problem);
  http::Problem problem_of(const WorkerExit& exit) const;
  Result<WorkerRequest> make_request(const store::JobRecord& job) const;
  void publish(const store::JobRecord& job);
  /// publish(), count and on_finished_: after the last change of a job.
  void conclude(const store::JobRecord& job);

  store::Store& store_;
  store::BlobStore& blobs_;
  const JobConfig config_;
  Watcher on_finished_;
  static constexpr std::size_t kinds = 4, states = 5;
  std::array<std::atomic<std::uint64_t>, kinds * states> ended_{};

  mutable std::mutex mutex_;  ///< guards what follows
  std::condition_variable changed_;
  std::deque<store::JobRecord> queue_;
  std::map<std::string, std::shared_ptr<Running>, std::less<>> running_;
  bool stopping_ = false;
  std::vector<std::thread> threads_;

  std::mutex watch_mutex_;  ///< held while watchers are called
  std::uint64_t next_watch_ = 1;
  std::map<std::uint64_t, std::pair<std::string, Watcher>> watchers_;
};

}  // namespace semblante::jobs
