#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "core/frame/frame_guess.h"
#include "core/types/result.h"
#include "server/store/blob_store.h"
#include "server/store/job_store.h"
#include "server/store/model_store.h"

namespace semblante::jobs {

/// The file of a model in a worker's request, and the model's frame.
struct ModelSource {
  std::string path;
  std::string file_name;            ///< as uploaded: a hint at the format
  std::optional<ModelFrame> frame;  ///< the current frame; empty before the first import
  FrameWish frame_wish;

  bool operator==(const ModelSource&) const = default;
};

/// A model with its feature points and parts.
struct MarkedSource {
  ModelSource model;
  std::vector<store::FeaturePointRecord> points;
  std::vector<store::PartRecord> parts;  ///< of the import; roles set by the user are kept
  store::FapuByUser fapu = {};           ///< lengths of units that the user gave; the others are measured

  bool operator==(const MarkedSource&) const = default;
};

/// The stores from which a job's request is made.
struct JobSources {
  store::ModelStore& store;
  const store::BlobStore& blobs;
};

/// The path of a blob that a job needs, of so many bytes if they are known. Throws store::DamagedBlob, "<what>: ...",
/// and store::StoreError.
std::string path_of(const store::BlobStore& blobs, const std::string& sha256, const std::string& what,
                    std::optional<std::uint64_t> bytes = {});
/// The model of a job. Error: missing.
Result<store::ModelRecord> model_of(const store::JobRecord& job, const JobSources& sources);
/// The file of a stored model. Throws as path_of().
ModelSource source_of(const store::ModelRecord& model, const JobSources& sources);
/// The same with the current feature points and parts of the model. Throws as path_of().
MarkedSource marked_source_of(const store::ModelRecord& model, const JobSources& sources);

// The readers throw nlohmann::json::exception on another form.
void to_json(nlohmann::json& json, const ModelSource& source);
void from_json(const nlohmann::json& json, ModelSource& source);
void to_json(nlohmann::json& json, const MarkedSource& source);
void from_json(const nlohmann::json& json, MarkedSource& source);

}  // namespace semblante::jobs
