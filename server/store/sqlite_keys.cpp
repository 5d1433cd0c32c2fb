#include "server/store/sqlite_keys.h"

namespace semblante::store {

void insert_key(Database& db, const std::optional<IdempotencyRecord>& key) {
  if (!key) return;
  // Keys serve retries, which come within a day.
  db.execute("DELETE FROM idempotency WHERE created < strftime('%Y-%m-%dT%H:%M:%fZ', 'now', '-1 day')");
  Statement(db, "INSERT INTO idempotency VALUES(?,?,?,?)")
      .bind(key->key, key->fingerprint, key->resource, timestamp_now())
      .run();
}

std::optional<IdempotencyRecord> find_key(Database& db, std::string_view key) {
  Statement statement(db, "SELECT key, fingerprint, resource FROM idempotency WHERE key = ?");
  statement.bind(key);
  if (!statement.step()) return std::nullopt;
  return IdempotencyRecord{statement.text(0), statement.text(1), statement.text(2)};
}

}  // namespace semblante::store
