#include "server/store/sqlite_database_facts.h"

#include <mutex>

#include "server/store/sqlite_schema.h"

namespace semblante::store {
namespace {

DatabaseIdentity read_identity(Database& db) {
  Statement statement(db, "SELECT id, starts FROM identity");
  if (!statement.step()) return {};
  return {statement.text(0), statement.whole(1)};
}

}  // namespace

DatabaseIdentity SqliteDatabaseFacts::identity() {
  const std::lock_guard lock(mutex_);
  return read_identity(db_);
}

DatabaseIdentity SqliteDatabaseFacts::count_start() {
  const std::lock_guard lock(mutex_);
  db_.execute("UPDATE identity SET starts = starts + 1");
  return read_identity(db_);
}

bool SqliteDatabaseFacts::healthy() {
  const std::lock_guard lock(mutex_);
  Statement statement(db_, "SELECT count(*) FROM streams");
  return statement.step();
}

void SqliteDatabaseFacts::check_writable() {
  const std::lock_guard lock(mutex_);
  set_schema_version(db_);
}

}  // namespace semblante::store
