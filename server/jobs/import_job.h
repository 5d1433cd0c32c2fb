#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "core/types/progress.h"
#include "core/types/result.h"
#include "server/jobs/model_source.h"
#include "server/store/job_store.h"

namespace semblante::jobs {

class InputFiles;
class ResultFiles;

/// Reads the file of a model and stores its facts. Has no options.
struct ImportJob {
  static constexpr std::string_view kind_name = "import";
  static constexpr bool needs_frame_to_stay = false;

  struct Request;
  struct Outcome;

  Result<Request> request(const store::JobRecord& job, const JobSources& sources) const;
  /// Files: `preview.glb`, `positions` (float32 x, y, z of each file vertex, little-endian, MPEG-4 frame) and
  /// `report.json` (findings from the mesh alone).
  static Result<Outcome> run(const Request& request, const InputFiles& inputs, ResultFiles& files,
                             const Progress& progress);
  std::vector<std::string> finish(store::JobRecord& job, Outcome outcome,
                                  const std::vector<store::ArtefactRecord>& artefacts, store::JobStore& store) const;
  /// A failed or cancelled first import makes its model failed.
  static std::vector<std::string> finish_without_outcome(const store::JobRecord& job, store::JobStore& store);

  bool operator==(const ImportJob&) const = default;
};

struct ImportJob::Request {
  ModelSource model;

  /// The files that a worker reads.
  [[nodiscard]] std::vector<std::string> inputs() const { return {model.path}; }

  bool operator==(const Request&) const = default;
};

struct ImportJob::Outcome {
  std::string format;
  std::uint32_t vertices = 0, triangles = 0;
  std::array<double, 3> box_min{}, box_max{};
  std::vector<store::PartRecord> parts;
  std::vector<std::string> warnings;
  store::FindingCounts findings;  ///< of the report
  ModelFrame frame;
  std::optional<store::Turn> turn;  ///< from the orientation in the request to the new one; empty: unchanged
  std::vector<store::MorphTargetRecord> morph_targets;
  std::uint32_t part_count = 0;  ///< of all parts, also those that are not in `parts`

  bool operator==(const Outcome&) const = default;
};

void to_json(nlohmann::json& json, const ImportJob& job);
void from_json(const nlohmann::json& json, ImportJob& job);
void to_json(nlohmann::json& json, const ImportJob::Request& request);
void from_json(const nlohmann::json& json, ImportJob::Request& request);
void to_json(nlohmann::json& json, const ImportJob::Outcome& outcome);
void from_json(const nlohmann::json& json, ImportJob::Outcome& outcome);

}  // namespace semblante::jobs
