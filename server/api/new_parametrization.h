#pragma once

#include <optional>

#include "server/store/store.h"

namespace semblante::api {

struct ParametrizationOptions {
  std::string metric = "edge", weights = "paper";
  int weight_bits = 12;
  std::vector<std::uint32_t> lods;  ///< as JobRecord::lods
};

/// Stores a parametrize job, durably. It is not queued yet.
store::JobRecord add_parametrization(store::Store& store, const std::string& model,
                                     const ParametrizationOptions& options,
                                     std::optional<store::IdempotencyRecord> key);

}  // namespace semblante::api
