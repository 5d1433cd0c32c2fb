#include "server/store/sqlite_recording_store.h"

#include <mutex>

#include "server/store/sqlite_keys.h"
#include "server/store/sqlite_recordings.h"

namespace semblante::store {

void SqliteRecordingStore::create_recording(const RecordingRecord& recording,
                                            const std::optional<IdempotencyRecord>& key) {
  const std::lock_guard lock(mutex_);
  Transaction transaction(db_);
  insert_recording(db_, recording);
  insert_key(db_, key);
  transaction.commit();
}

std::optional<RecordingRecord> SqliteRecordingStore::recording(std::string_view id) {
  const std::lock_guard lock(mutex_);
  return find_recording(db_, id);
}

std::optional<RecordingRecord> SqliteRecordingStore::newest_recording(std::string_view stream) {
  const std::lock_guard lock(mutex_);
  return find_newest_recording(db_, stream);
}

std::optional<std::vector<RecordingRecord>> SqliteRecordingStore::recordings(std::string_view stream,
                                                                             std::string_view after,
                                                                             std::size_t limit) {
  const std::lock_guard lock(mutex_);
  return list_recordings(db_, stream, after, limit);
}

std::size_t SqliteRecordingStore::recording_count() {
  const std::lock_guard lock(mutex_);
  Statement statement(db_, "SELECT count(*) FROM recordings");
  statement.step();
  return static_cast<std::size_t>(statement.integer(0));
}

void SqliteRecordingStore::finish_recording(const RecordingRecord& recording) {
  const std::lock_guard lock(mutex_);
  write_recording(db_, recording);
}

bool SqliteRecordingStore::remove_recording(std::string_view id) {
  const std::lock_guard lock(mutex_);
  Statement(db_, "DELETE FROM recordings WHERE id = ?").bind(id).run();
  return db_.changes() != 0;
}

}  // namespace semblante::store
