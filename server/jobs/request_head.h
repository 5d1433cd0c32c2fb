#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/pipeline/marked.h"
#include "server/jobs/model_source.h"

namespace semblante::jobs {

/// The bytes of a file the server named. Error: io.
Result<std::vector<std::uint8_t>> read_file(const std::string& path);

/// What a model file lacks or contradicts is a fault of the file. Elsewhere in a job the same codes are about the
/// feature points and fields of the request, and problem_from names them so.
Error about_the_file(Error error);

/// Stage 1 of core/pipeline on a job's model.
Result<ImportedHead> import_source(const ModelSource& source, const Progress& progress);

/// Stages 2 and 3 for the jobs after an import: the head stands as the import found, and gets the points of the source.
Result<MarkedHead> mark_source(ImportedHead head, const MarkedSource& source, const Progress& progress);

}  // namespace semblante::jobs
