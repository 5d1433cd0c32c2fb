#pragma once

#include <variant>

#include "server/jobs/extract_job.h"
#include "server/jobs/import_job.h"
#include "server/jobs/parametrize_job.h"
#include "server/jobs/propose_job.h"

namespace semblante::jobs {

/// Every type of job. To add one: its header and source, a line here, and a line in CMakeLists.txt; the concept JobType
/// in job.h has its requirements. The members of a type are the options of its jobs.
using Job = std::variant<ImportJob, ParametrizeJob, ProposeJob, ExtractJob>;

}  // namespace semblante::jobs
