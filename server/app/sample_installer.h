#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "server/jobs/job_queue.h"

namespace semblante {

inline constexpr std::string_view sample_model_id = "sample";

/// Sees to it that the model `sample` is there, marked and parametrized, by the same jobs as anybody's model. Each step
/// begins when the one before is done; a restart goes on where it stopped, and a step that the store cannot take is a
/// pending write. begin() from the main thread, then job_finished() from any.
class SampleInstaller {
 public:
  /// `file`: the model, with its feature points beside it in <stem>.fps.json; empty: no sample. Throws CommandFailure
  /// when a file is missing or cannot be read.
  SampleInstaller(store::Store& store, store::BlobStore& blobs, store::PendingWrites& pending, jobs::JobQueue& queue,
                  std::filesystem::path file);
  ~SampleInstaller();
  SampleInstaller(const SampleInstaller&) = delete;
  SampleInstaller& operator=(const SampleInstaller&) = delete;

  /// The first step that is left to do, after the queue's start.
  void begin();
  void job_finished(const store::JobRecord& job);

 private:
  /// The next step, by what is in the store; nothing when there is none. Throws StoreError.
  void take_next_step();
  void import();
  void parametrize();

  store::Store& store_;
  store::BlobStore& blobs_;
  store::PendingWrites& pending_;
  jobs::JobQueue& queue_;
  const std::filesystem::path file_;
  std::string hash_;
  std::vector<store::FeaturePointRecord> points_;
};

}  // namespace semblante
