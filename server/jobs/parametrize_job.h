#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "core/extract/named_set.h"
#include "core/types/progress.h"
#include "core/types/result.h"
#include "server/jobs/model_source.h"
#include "server/store/job_store.h"

namespace semblante::jobs {

class InputFiles;
class ResultFiles;

/// Makes the face package of a model from its feature points.
struct ParametrizeJob {
  static constexpr std::string_view kind_name = "parametrize";
  static constexpr bool needs_frame_to_stay = true;

  std::string metric = "edge";
  std::string weights = "paper";
  int weight_bits = 12;
  std::vector<std::uint32_t> lods;                    ///< vertex budgets of the levels of detail, decreasing
  std::string expressions = "library";                ///< or "own": those of the head's own shapes, where it has them
  std::optional<double> articulation = std::nullopt;  ///< empty: that of the head's own shapes, or the usual one

  struct Request;
  struct Outcome;

  Result<Request> request(const store::JobRecord& job, const JobSources& sources) const;
  /// Files: those of the package and `report.json`; if the feature points turn the model, also those of an import.
  static Result<Outcome> run(const Request& request, const InputFiles& inputs, ResultFiles& files,
                             const Progress& progress);
  std::vector<std::string> finish(store::JobRecord& job, Outcome outcome,
                                  const std::vector<store::ArtefactRecord>& artefacts, store::JobStore& store) const;

  bool operator==(const ParametrizeJob&) const = default;
};

struct ParametrizeJob::Request {
  std::string model_name;
  MarkedSource head;
  ParametrizeJob options;
  std::vector<NamedSet> worn;  ///< the sets that replace those of the library, with the same names

  /// The files that a worker reads.
  [[nodiscard]] std::vector<std::string> inputs() const { return {head.model.path}; }
};

struct ParametrizeJob::Outcome {
  std::vector<store::PartRecord> parts;
  std::vector<std::string> warnings;
  store::FindingCounts findings;           ///< of the report
  store::FrameUpdate frame;                ///< `frame` is always set
  std::vector<store::LevelRecord> levels;  ///< the full mesh first

  bool operator==(const Outcome&) const = default;
};

void to_json(nlohmann::json& json, const ParametrizeJob& job);
void from_json(const nlohmann::json& json, ParametrizeJob& job);
void to_json(nlohmann::json& json, const ParametrizeJob::Request& request);
void from_json(const nlohmann::json& json, ParametrizeJob::Request& request);
void to_json(nlohmann::json& json, const ParametrizeJob::Outcome& outcome);
void from_json(const nlohmann::json& json, ParametrizeJob::Outcome& outcome);

}  // namespace semblante::jobs
