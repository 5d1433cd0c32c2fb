#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/types/result.h"
#include "server/http/problem.h"
#include "server/jobs/job.h"

namespace semblante::jobs {

/// The request to a worker process on its standard input, as one JSON text.
struct WorkerRequest {
  std::string output_directory;  ///< an existing empty directory; artefacts are written there under their names
  JobRequest job;
};

/// The limits that a worker sets for itself before it reads the model. 0: no limit.
struct WorkerLimits {
  std::uint64_t memory_bytes = std::uint64_t{4} << 30U;
  std::uint64_t cpu_seconds = 300;
  std::uint64_t file_bytes = std::uint64_t{1} << 30U;
};

/// The outcome of a worker.
struct WorkerResult {
  JobOutcome outcome;
  std::vector<store::ArtefactRecord> artefacts;  ///< files in the output directory; their sha256 is not set yet
};

struct WorkerProgress {
  double progress = 0.0;
  std::string stage;
};

/// One line of a worker's standard output: progress, result or problem.
using WorkerLine = std::variant<WorkerProgress, WorkerResult, http::Problem>;

std::string to_json(const WorkerRequest& request);
Result<WorkerRequest> worker_request_from_json(std::string_view text);
std::string to_json_line(const WorkerLine& line);
/// Errors: the line is not valid (a crashing worker may write anything).
Result<WorkerLine> worker_line_from_json(std::string_view text);

}  // namespace semblante::jobs
