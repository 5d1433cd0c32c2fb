#pragma once

#include <array>
#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "server/jobs/job_run.h"
#include "server/jobs/job_watchers.h"
#include "server/jobs/next_state.h"
#include "server/store/pending_writes.h"

namespace semblante::jobs {

/// The result of a request to cancel.
enum class Cancelled {
  none,      ///< there is no such job, or it has ended
  recorded,  ///< durable: it will not run again
  pending,   ///< it has been stopped; this will be stored when the store can be written again
};

/// Runs jobs in order, each in a worker process, and stores their results. Jobs of one model never run at the same
/// time. On a full disk a job waits until there is space; an end that cannot be stored is a pending write, and until it
/// is durable the job keeps its state, with the stage "saving". Owns its threads; store, blobs and pending writes must
/// outlive it. All calls from any thread except I/O threads.
class JobQueue {
 public:
  using Watcher = JobWatchers::Watcher;

  JobQueue(JobStores stores, store::BlobStore& blobs, store::PendingWrites& pending, JobConfig config);
  ~JobQueue();
  JobQueue(const JobQueue&) = delete;
  JobQueue& operator=(const JobQueue&) = delete;

  /// Queues the unfinished jobs of an earlier process, then starts the threads.
  void start();
  /// Kills the workers; their jobs stay unfinished in the store, for the next start.
  void stop();

  /// False when the queue is full.
  [[nodiscard]] bool has_room() const;
  /// Queues a job that is already stored.
  void enqueue(const store::JobRecord& job);
  /// A queued job ends immediately, a running one within seconds.
  Cancelled cancel(std::string_view id);
  /// Cancels the jobs of a model that is about to be removed; returns when none is running.
  void cancel_all_of(std::string_view model);

  /// The current job; its progress is newer than in the store.
  [[nodiscard]] std::optional<store::JobRecord> find(std::string_view id) const;
  /// Calls `watcher` at every change of the job from now on, from the queue's threads. Pair with unwatch().
  std::uint64_t watch(std::string_view id, Watcher watcher) { return watchers_.add(id, std::move(watcher)); }
  /// The watcher is not called after this returns.
  void unwatch(std::uint64_t watch) { watchers_.remove(watch); }
  /// Called after the end of every job is durable, from the queue's threads or that of the pending writes. Before
  /// start().
  void on_finished(Watcher watcher) { on_finished_ = std::move(watcher); }

  /// What holds the workers to their jobs on this system.
  [[nodiscard]] const Isolation& isolation() const { return config_.isolation; }
  [[nodiscard]] std::size_t waiting() const;
  [[nodiscard]] std::size_t running() const;
  /// Number of jobs of a kind (a name in job_kinds) that ended with this state (done, failed, cancelled) since the
  /// queue was made.
  [[nodiscard]] std::uint64_t ended(std::string_view kind, store::JobState state) const;

 private:
  struct Running {
    store::JobRecord job;
    std::atomic<bool> cancel{false};
  };
  void work();
  /// The first job that may start: jobs of one model run one after another, each on the results of the one before.
  std::deque<store::JobRecord>::iterator next();
  [[nodiscard]] bool is_busy(const std::string& model) const;
  /// Runs an attempt and returns the job's next state: ended, or queued again. nullopt when the server is shutting
  /// down.
  std::optional<NextState> attempt(Running& running);
  std::optional<store::JobRecord> run_once(Running& running, JobRun& attempt);
  NextState after_store_error(const Running& running, const JobRun& attempt, const store::StoreError& fault);
  /// Stores the next state, now or later; true when it is durable.
  bool record(NextState next);
  /// The write behind record(); throws.
  void settle(const std::string& id);
  void write_next(const store::JobRecord& next, std::uint64_t room_needed);
  /// To be called after the last change of a job: notifies its watchers, updates the counters and calls on_finished_.
  void conclude(const store::JobRecord& job);

  const JobStores stores_;
  store::BlobStore& blobs_;
  store::PendingWrites& pending_;
  const JobConfig config_;
  JobWatchers watchers_;
  Watcher on_finished_;
  std::array<std::array<std::atomic<std::uint64_t>, store::job_state_count>, job_kinds.size()> ended_{};

  mutable std::mutex mutex_;  ///< guards the members below
  std::condition_variable changed_;
  std::deque<store::JobRecord> queue_;
  std::map<std::string, std::shared_ptr<Running>, std::less<>> running_;
  std::map<std::string, NextState, std::less<>> unrecorded_;     ///< of jobs whose next state is not stored yet
  std::map<std::string, std::uint32_t, std::less<>> shortages_;  ///< attempts of a job that failed because of the disk
  bool stopping_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace semblante::jobs
