#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "server/store/records.h"
#include "server/store/sqlite.h"

// Rows of displacement sets, and of the copies that models use. Callers hold the store's mutex.
namespace semblante::store {

void insert_set(Database& db, const SetRecord& set);
std::optional<SetRecord> find_set(Database& db, std::string_view id);
/// As Store::sets.
std::optional<std::vector<SetRecord>> list_sets(Database& db, std::string_view after, std::size_t limit);

/// The sets that replace those of the library in a model, by slot name.
std::vector<WornSet> read_worn(Database& db, std::string_view model);
/// The same without displacements.
std::vector<WornSet> read_worn_names(Database& db, std::string_view model);
/// A set without displacements removes the row of its slot.
void write_worn(Database& db, std::string_view model, const WornSet& worn);

}  // namespace semblante::store
