#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "core/extract/extract.h"
#include "core/types/progress.h"
#include "core/types/result.h"
#include "server/jobs/model_source.h"
#include "server/store/job_store.h"

namespace semblante::jobs {

class InputFiles;
class ResultFiles;

/// Extracts a displacement set from two shapes of a head: a model and one of its morph targets, or a model and a file
/// of the same mesh. Without a model the neutral head is a file too.
struct ExtractJob {
  static constexpr std::string_view kind_name = "extract";
  static constexpr bool needs_frame_to_stay = false;

  std::string name;                 ///< of the new set
  std::string kind = "expression";  ///< one of set_kind_names
  bool align = false;
  double least = 1.0, strength = 1.0;  ///< see ExtractOptions
  std::string target, from;
  std::string expression_file, expression_sha256;
  std::string neutral_file, neutral_sha256;
  std::vector<store::FeaturePointRecord> points;  ///< of the neutral file

  struct Request;
  struct Outcome;

  /// The blobs that belong to the job until it ends.
  [[nodiscard]] std::vector<std::string> files() const;

  Result<Request> request(const store::JobRecord& job, const JobSources& sources) const;
  static Result<Outcome> run(const Request& request, const InputFiles& inputs, ResultFiles& files,
                             const Progress& progress);
  std::vector<std::string> finish(store::JobRecord& job, const Outcome& outcome,
                                  const std::vector<store::ArtefactRecord>& artefacts, store::JobStore& store) const;

  bool operator==(const ExtractJob&) const = default;
};

struct ExtractJob::Request {
  MarkedSource head;
  ExtractJob wish;
  std::string expression_path;  ///< of the expression's bytes; empty: morph targets of the head

  /// The files that a worker reads.
  [[nodiscard]] std::vector<std::string> inputs() const;

  bool operator==(const Request&) const = default;
};

struct ExtractJob::Outcome {
  Extraction extraction;
};

void to_json(nlohmann::json& json, const ExtractJob& job);
void from_json(const nlohmann::json& json, ExtractJob& job);
void to_json(nlohmann::json& json, const ExtractJob::Request& request);
void from_json(const nlohmann::json& json, ExtractJob::Request& request);
void to_json(nlohmann::json& json, const ExtractJob::Outcome& outcome);
/// Throws std::invalid_argument too, for an invalid feature point, unit or displacement.
void from_json(const nlohmann::json& json, ExtractJob::Outcome& outcome);

}  // namespace semblante::jobs
