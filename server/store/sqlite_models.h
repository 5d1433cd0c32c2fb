#pragma once

// Private to store/: rows of models with their packages, and of feature points. Within the caller's transaction.

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "server/store/records.h"
#include "server/store/sqlite.h"

namespace semblante::store {

/// False when the id is taken.
bool insert_model(Database& db, const ModelRecord& model);
std::optional<ModelRecord> find_model(Database& db, std::string_view id);
/// In order of creation, after the model `after` (empty: from the first); nullopt when `after` does not exist.
std::optional<std::vector<ModelRecord>> list_models(Database& db, std::string_view after, std::size_t limit);

std::vector<FeaturePointRecord> read_points(Database& db, std::string_view model);
void write_points(Database& db, std::string_view model, const std::vector<FeaturePointRecord>& points);
/// Turns the marked positions as the model was turned.
void turn_points(Database& db, std::string_view model, const Turn& r);

}  // namespace semblante::store
