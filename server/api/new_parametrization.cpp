#include "server/api/new_parametrization.h"

#include <utility>

namespace semblante::api {

store::JobRecord add_parametrization(store::Store& store, const std::string& model,
                                     const ParametrizationOptions& options,
                                     std::optional<store::IdempotencyRecord> key) {
  store::JobRecord job;
  job.id = store::random_id();
  job.model = model;
  job.kind = store::JobKind::parametrize;
  job.created = job.updated = store::timestamp_now();
  job.metric = options.metric;
  job.weights = options.weights;
  job.weight_bits = options.weight_bits;
  job.lods = options.lods;
  if (key) key->resource = job.id;
  store.create_job(job, key);
  return job;
}

}  // namespace semblante::api
