#pragma once

#include <variant>

#include "server/jobs/extract_job.h"
#include "server/jobs/import_job.h"
#include "server/jobs/parametrize_job.h"
#include "server/jobs/propose_job.h"

namespace semblante::jobs {

/// Every type of job. A new one is its header and source, a line here, and a line in CMakeLists.txt; what it must have
/// is the concept JobType in job.h. A job of a type holds what is asked for.
using Job = std::variant<ImportJob, ParametrizeJob, ProposeJob, ExtractJob>;

}  // namespace semblante::jobs
