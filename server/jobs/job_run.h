#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "server/jobs/isolation.h"
#include "server/jobs/worker_process.h"
#include "server/jobs/worker_protocol.h"
#include "server/store/artefact_store.h"
#include "server/store/blob_store.h"
#include "server/store/job_store.h"
#include "server/store/model_store.h"

namespace semblante::jobs {

struct JobConfig {
  std::vector<std::string> worker_command;  ///< program and arguments; the limits are added
  WorkerLimits limits;
  Isolation isolation;  ///< the means that this system offers, for /metrics
  std::chrono::seconds wall_limit{900};
  unsigned concurrency = 1;     ///< workers at the same time
  std::size_t max_queued = 64;  ///< waiting jobs; further requests get 429
  std::uint32_t max_attempts = 3;
};

/// The parts of the store that jobs read and change.
struct JobStores {
  store::JobStore& jobs;
  store::ModelStore& models;
  store::ArtefactStore& artefacts;
};

/// One attempt at a job: its worker process, and the commit of its result. Used by one thread.
class JobRun {
 public:
  using OnProgress = std::function<void(const WorkerProgress&)>;

  JobRun(JobStores stores, store::BlobStore& blobs, const JobConfig& config)
      : stores_(stores), blobs_(blobs), config_(config) {}

  /// The ended job: `done` is durable with its result, another end is not stored yet. nullopt when it was stopped with
  /// the server. Throws StoreError when its files or its result could not be written: then nothing of the attempt
  /// remains, and it can be repeated.
  std::optional<store::JobRecord> run(const store::JobRecord& job, const OnProgress& on_progress,
                                      const std::function<Wish()>& wish);

  /// After StoreError: whether the job's run() was called, and the free bytes needed for another attempt.
  [[nodiscard]] bool has_begun() const { return has_begun_; }
  [[nodiscard]] std::uint64_t room_needed() const { return room_needed_; }

 private:
  std::optional<store::JobRecord> work(const store::JobRecord& job, const WorkerRequest& request,
                                       const OnProgress& on_progress, const std::function<Wish()>& wish);
  http::Problem problem_of(const WorkerExit& exit) const;
  store::JobRecord keep_result(const store::JobRecord& job, const WorkerRequest& request, WorkerResult result);
  /// Returns a problem when the worker names a file that it may not. Throws StoreError when one cannot be stored.
  std::optional<http::Problem> adopt_artefacts(const WorkerRequest& request, WorkerResult& result);
  /// Removes the artefacts' blobs that no record refers to.
  void discard(const WorkerResult& result) const;

  const JobStores stores_;
  store::BlobStore& blobs_;
  const JobConfig& config_;
  static constexpr std::uint64_t least_room = std::uint64_t{1} << 20U;
  bool has_begun_ = false;
  std::uint64_t adopted_bytes_ = 0, room_needed_ = least_room;
};

}  // namespace semblante::jobs
