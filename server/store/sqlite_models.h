#pragma once

// Private to store/: rows of models with what belongs to one, and of feature points. Within the caller's transaction.

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "server/store/records.h"
#include "server/store/sqlite.h"

namespace semblante::store {

/// False when there is a model of that id.
bool insert_model(Database& db, const ModelRecord& model);
std::optional<ModelRecord> find_model(Database& db, std::string_view id);
/// In order of creation, those after the model `after` (empty: from the first); nullopt when there is none of that id.
std::optional<std::vector<ModelRecord>> list_models(Database& db, std::string_view after, std::size_t limit);

std::vector<FeaturePointRecord> read_points(Database& db, std::string_view model);
void write_points(Database& db, std::string_view model, const std::vector<FeaturePointRecord>& points);
/// Marked positions go where the model goes.
void turn_points(Database& db, std::string_view model, const Turn& r);

}  // namespace semblante::store
