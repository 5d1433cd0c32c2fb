#pragma once

#include "server/jobs/worker_protocol.h"

namespace semblante::jobs {

/// Puts the limits on this very process, and ties its life to its parent's. Before a byte of a model is read.
void limit_this_process(const WorkerLimits& limits);

/// The body of `semblante worker`: reads the request from standard input, does it, reports on standard output. The exit
/// code: 0 done, 2 a problem was reported, 1 not even that.
int run_worker();

}  // namespace semblante::jobs
