#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/types/result.h"
#include "server/http/problem.h"
#include "server/store/records.h"

namespace semblante::jobs {

/// What a worker process is told on its standard input, as one JSON text.
struct WorkerRequest {
  store::JobKind kind = store::JobKind::import;
  std::string source;               ///< path of the model's bytes
  std::string file_name;            ///< as uploaded: a hint of the format
  std::string name;                 ///< of the model
  std::string output_directory;     ///< exists, empty: artefacts go here by their name
  std::optional<ModelFrame> frame;  ///< how the model stands so far; none in its first import
  FrameWish frame_wish;
  // parametrize and propose only
  std::vector<store::FeaturePointRecord> points;  ///< to propose: the placed ones
  std::vector<store::PartRecord> parts;           ///< of the import; roles set by the user are kept
  std::string metric = "edge", weights = "paper";
  int weight_bits = 12;
  std::vector<std::uint32_t> lods;   ///< as JobRecord::lods
  std::vector<store::WornSet> worn;  ///< to parametrize: what the face wears in place of the library's sets
  // extract only
  std::optional<store::ExtractionRecord> extraction;
  std::string expression_source;  ///< path of the expression's bytes; empty: morph targets of the source
};

/// The limits a worker puts on itself before it reads a byte of the model. 0: none.
struct WorkerLimits {
  std::uint64_t memory_bytes = std::uint64_t{4} << 30U;
  std::uint64_t cpu_seconds = 300;
  std::uint64_t file_bytes = std::uint64_t{1} << 30U;
};

/// What it found out; the artefacts are files in the output directory (sha256 still empty).
struct WorkerResult {
  std::string format;
  std::uint32_t vertices = 0, triangles = 0;
  std::array<double, 3> box_min{}, box_max{};
  std::vector<store::PartRecord> parts;
  std::vector<std::string> warnings;
  std::optional<store::FindingCounts> findings;  ///< of the report
  std::optional<ModelFrame> frame;
  std::optional<store::Turn> turn;  ///< from how it stood in the request to how it stands now; none: as it was
  std::vector<store::MorphTargetRecord> morph_targets;
  std::vector<store::LevelRecord> levels;  ///< of the package, the full mesh first
  std::vector<store::ArtefactRecord> artefacts;
  std::vector<store::FeaturePointRecord> proposals;               ///< of a proposal: the points nobody placed
  std::vector<std::pair<std::string, std::string>> not_proposed;  ///< of a proposal: point, reason
  std::string displacements;  ///< of an extraction: JSON, as displacements_to_json writes it
  std::string taken;          ///< of an extraction: JSON of what is in the set and what is not, and why
};

/// One line of a worker's standard output: progress, or the end.
struct WorkerLine {
  enum class Kind { progress, done, problem } kind = Kind::progress;
  double progress = 0.0;
  std::string stage;
  WorkerResult result;
  http::Problem problem;
};

/// What a proposal has to say beside the points it added, as JSON: how many, and why not the others.
std::string proposal_result(const WorkerResult& result);

/// What an extraction's job has to say: the id of the set, and what is in it.
std::string extraction_result(const std::string& set, const WorkerResult& result);
/// What the set itself says of where it is from.
std::string extraction_source(const store::JobRecord& job, const WorkerResult& result);

std::string to_json(const WorkerRequest& request);
Result<WorkerRequest> worker_request_from_json(std::string_view text);
std::string to_json_line(const WorkerLine& line);
/// Errors: the line is not one of ours (a crashing worker may write anything).
Result<WorkerLine> worker_line_from_json(std::string_view text);

}  // namespace semblante::jobs
