#pragma once

#include <optional>
#include <string>

#include "server/jobs/parametrize_job.h"
#include "server/store/job_store.h"

namespace semblante::api {

/// Stores a parametrize job, durably. It is not queued yet.
store::JobRecord add_parametrization(store::JobStore& store, const std::string& model,
                                     const jobs::ParametrizeJob& options, std::optional<store::IdempotencyRecord> key,
                                     store::Origin origin = {});

}  // namespace semblante::api
