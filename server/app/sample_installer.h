#pragma once

#include <filesystem>
#include <string_view>

#include "server/jobs/job_queue.h"

namespace semblante {

inline constexpr std::string_view sample_model_id = "sample";

/// Sees to it that the model `sample` is there, marked and parametrized, by the same jobs as anybody's model. Each step
/// begins when the one before is done; a restart goes on where it stopped. begin() from the main thread, then
/// job_finished() from the queue's threads.
class SampleInstaller {
 public:
  /// `file`: the model, with its feature points beside it in <stem>.fps.json; empty: no sample.
  SampleInstaller(store::Store& store, store::BlobStore& blobs, jobs::JobQueue& queue, std::filesystem::path file);

  /// Throws CommandFailure when a file is missing or cannot be read.
  void begin();
  void job_finished(const store::JobRecord& job);

 private:
  void import();
  void parametrize();

  store::Store& store_;
  store::BlobStore& blobs_;
  jobs::JobQueue& queue_;
  const std::filesystem::path file_;
  std::vector<store::FeaturePointRecord> points_;
};

}  // namespace semblante
