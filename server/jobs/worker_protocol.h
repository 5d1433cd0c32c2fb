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
