#include "server/store/sqlite_set_store.h"

#include <mutex>

#include "server/store/sqlite_keys.h"
#include "server/store/sqlite_sets.h"

namespace semblante::store {

void SqliteSetStore::create_set(const SetRecord& set, const std::optional<IdempotencyRecord>& key) {
  const std::lock_guard lock(mutex_);
  Transaction transaction(db_);
  insert_set(db_, set);
  insert_key(db_, key);
  transaction.commit();
}

std::optional<SetRecord> SqliteSetStore::set(std::string_view id) {
  const std::lock_guard lock(mutex_);
  return find_set(db_, id);
}

std::optional<std::vector<SetRecord>> SqliteSetStore::sets(std::string_view after, std::size_t limit) {
  const std::lock_guard lock(mutex_);
  return list_sets(db_, after, limit);
}

std::size_t SqliteSetStore::set_count() {
  const std::lock_guard lock(mutex_);
  Statement statement(db_, "SELECT count(*) FROM displacement_sets");
  statement.step();
  return static_cast<std::size_t>(statement.integer(0));
}

bool SqliteSetStore::put_set(const SetRecord& set) {
  const std::lock_guard lock(mutex_);
  Statement(db_,
            "UPDATE displacement_sets SET name = ?, kind = ?, displacements = ?, revision = revision + 1, "
            "updated = ? WHERE id = ? AND revision = ?")
      .bind(set.name, set.kind, set.displacements, timestamp_now(), set.id, set.revision)
      .run();
  return db_.changes() != 0;
}

bool SqliteSetStore::remove_set(std::string_view id) {
  const std::lock_guard lock(mutex_);
  Statement(db_, "DELETE FROM displacement_sets WHERE id = ?").bind(id).run();
  return db_.changes() != 0;
}

}  // namespace semblante::store
