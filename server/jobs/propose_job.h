#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "core/types/progress.h"
#include "core/types/result.h"
#include "server/jobs/model_source.h"
#include "server/store/job_store.h"

namespace semblante::jobs {

class InputFiles;
class ResultFiles;

/// Proposes the missing feature points from the placed ones. Has no options.
struct ProposeJob {
  static constexpr std::string_view kind_name = "propose";
  static constexpr bool needs_frame_to_stay = true;

  struct Request;
  struct Outcome;

  Result<Request> request(const store::JobRecord& job, const JobSources& sources) const;
  static Result<Outcome> run(const Request& request, const InputFiles& inputs, ResultFiles& files,
                             const Progress& progress);
  std::vector<std::string> finish(store::JobRecord& job, const Outcome& outcome,
                                  const std::vector<store::ArtefactRecord>& artefacts, store::JobStore& store) const;

  bool operator==(const ProposeJob&) const = default;
};

struct ProposeJob::Request {
  MarkedSource head;  ///< with the placed points only

  /// The files that a worker reads.
  [[nodiscard]] std::vector<std::string> inputs() const { return {head.model.path}; }

  bool operator==(const Request&) const = default;
};

struct ProposeJob::Outcome {
  std::vector<store::FeaturePointRecord> proposals;               ///< for points that are not placed
  std::vector<std::pair<std::string, std::string>> not_proposed;  ///< each point without a proposal, and the reason

  bool operator==(const Outcome&) const = default;
};

void to_json(nlohmann::json& json, const ProposeJob& job);
void from_json(const nlohmann::json& json, ProposeJob& job);
void to_json(nlohmann::json& json, const ProposeJob::Request& request);
void from_json(const nlohmann::json& json, ProposeJob::Request& request);
void to_json(nlohmann::json& json, const ProposeJob::Outcome& outcome);
void from_json(const nlohmann::json& json, ProposeJob::Outcome& outcome);

}  // namespace semblante::jobs
