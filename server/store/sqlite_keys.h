#pragma once

// Private to store/: rows of idempotency keys. Within the caller's transaction.

#include <optional>
#include <string_view>

#include "server/store/records.h"
#include "server/store/sqlite.h"

namespace semblante::store {

/// Does nothing without a key. Removes old keys.
void insert_key(Database& db, const std::optional<IdempotencyRecord>& key);
std::optional<IdempotencyRecord> find_key(Database& db, std::string_view key);

}  // namespace semblante::store
