#include "server/api/new_parametrization.h"

#include <utility>

#include "server/jobs/job.h"

namespace semblante::api {

store::JobRecord add_parametrization(store::JobStore& store, const std::string& model,
                                     const jobs::ParametrizeJob& options, std::optional<store::IdempotencyRecord> key,
                                     store::Origin origin) {
  auto job = jobs::new_record(options, model, std::move(origin));
  if (key) key->resource = job.id;
  store.create_job(job, {}, key);
  return job;
}

}  // namespace semblante::api
