#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "server/jobs/job_queue.h"

namespace semblante {

inline constexpr std::string_view sample_model_id = "sample";

/// Installs the model `sample`, marked and parametrized, by the same jobs as other models. Each step begins when the
/// one before is done; a restart continues with the next step, and a step that cannot be stored is a pending write.
/// begin() from the main thread, then job_finished() from any thread.
class SampleInstaller {
 public:
  /// `file`: the model, with its feature points beside it in <stem>.fps.json; empty: no sample. Throws CommandFailure
  /// when a file is missing or cannot be read.
  SampleInstaller(store::ModelStore& models, store::JobStore& jobs, store::BlobStore& blobs,
                  store::PendingWrites& pending, jobs::JobQueue& queue, std::filesystem::path file);
  ~SampleInstaller();
  SampleInstaller(const SampleInstaller&) = delete;
  SampleInstaller& operator=(const SampleInstaller&) = delete;

  /// Starts the first remaining step; to be called after the queue's start.
  void begin();
  void job_finished(const store::JobRecord& job);

 private:
  /// Starts the next step, determined by the store; does nothing when all are done. Throws StoreError.
  void take_next_step();
  void import();
  void parametrize();

  store::ModelStore& models_;
  store::JobStore& jobs_;
  store::BlobStore& blobs_;
  store::PendingWrites& pending_;
  jobs::JobQueue& queue_;
  const std::filesystem::path file_;
  std::string hash_;
  std::vector<store::FeaturePointRecord> points_;
};

}  // namespace semblante
