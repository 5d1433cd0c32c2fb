#pragma once

#include <functional>

#include "server/jobs/input_files.h"
#include "server/jobs/process_limits.h"
#include "server/jobs/result_files.h"
#include "server/jobs/worker_protocol.h"

namespace semblante::jobs {

/// What a worker does in its isolation; tests do other things in it.
using RunJob = std::function<Result<JobOutcome>(const JobRequest&, const InputFiles&, ResultFiles&, const Progress&)>;

/// The body of `semblante worker`: reads the request from standard input, opens its files, isolates this process,
/// executes the request, reports on standard output. Exit codes: 0 done, 2 a problem was reported, 1 the report failed
/// too.
int run_worker(const RunJob& run_job = run);

}  // namespace semblante::jobs
