#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/pipeline/marked.h"
#include "server/jobs/input_files.h"
#include "server/jobs/model_source.h"

namespace semblante::jobs {

/// Marks an error as one of the model file. Elsewhere in a job the same codes are about the feature points and fields
/// of the request, and problem_from makes other problems of them.
Error about_the_file(Error error);

/// Stage 1 of core/pipeline on a job's model.
Result<ImportedHead> import_source(const ModelSource& source, const InputFiles& inputs, const Progress& progress);

/// Stages 2 and 3 for the jobs after an import: the head has the frame of the import, and gets the points of the
/// source.
Result<MarkedHead> mark_source(ImportedHead head, const MarkedSource& source, const Progress& progress);

}  // namespace semblante::jobs
