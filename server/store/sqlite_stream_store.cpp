#include "server/store/sqlite_stream_store.h"

#include <mutex>

#include "server/store/sqlite_keys.h"
#include "server/store/sqlite_streams.h"

namespace semblante::store {

bool SqliteStreamStore::create_stream(const StreamRecord& stream, const std::optional<IdempotencyRecord>& key) {
  const std::lock_guard lock(mutex_);
  Transaction transaction(db_);
  if (!insert_stream(db_, stream)) return false;
  insert_key(db_, key);
  transaction.commit();
  return true;
}

std::vector<StreamRecord> SqliteStreamStore::streams() {
  const std::lock_guard lock(mutex_);
  return list_streams(db_);
}

bool SqliteStreamStore::remove_stream(std::string_view id) {
  const std::lock_guard lock(mutex_);
  Statement(db_, "DELETE FROM streams WHERE id = ?").bind(id).run();
  return db_.changes() != 0;
}

}  // namespace semblante::store
