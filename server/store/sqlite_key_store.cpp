#include "server/store/sqlite_key_store.h"

#include <mutex>

#include "server/store/sqlite_keys.h"

namespace semblante::store {

std::optional<IdempotencyRecord> SqliteKeyStore::idempotency(std::string_view key) {
  const std::lock_guard lock(mutex_);
  return find_key(db_, key);
}

}  // namespace semblante::store
