#pragma once

#include "server/jobs/worker_protocol.h"

namespace semblante::jobs {

/// Sets the limits of this process, and its death signal on the parent's end. To be called before a byte of a model is
/// read.
void limit_this_process(const WorkerLimits& limits);

/// The body of `semblante worker`: reads the request from standard input, executes it, reports on standard output. Exit
/// codes: 0 done, 2 a problem was reported, 1 the report failed too.
int run_worker();

}  // namespace semblante::jobs
