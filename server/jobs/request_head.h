#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/pipeline/marked.h"
#include "server/jobs/worker_protocol.h"

namespace semblante::jobs {

/// The bytes of a file the server named. Error: io.
Result<std::vector<std::uint8_t>> read_file(const std::string& path);

/// What a model file lacks or contradicts is a fault of the file. Elsewhere in a job the same codes are about the
/// feature points and fields of the request, and problem_from names them so.
Error about_the_file(Error error);

/// Stage 1 of core/pipeline on the request's source.
Result<ImportedHead> import_source(const WorkerRequest& request, const Progress& progress);

/// Stages 2 and 3 for the jobs after an import: the head stands as the import found, and gets the request's points.
Result<MarkedHead> mark_source(ImportedHead head, const WorkerRequest& request, const Progress& progress);

}  // namespace semblante::jobs
