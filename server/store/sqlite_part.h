#pragma once

// Private to store/.

#include <mutex>
#include <string>

#include "server/store/sqlite.h"

namespace semblante::store {

/// The one connection to the database file, and the mutex that guards it.
struct SqliteConnection {
  explicit SqliteConnection(const std::string& file) : db(file) {}

  std::mutex mutex;
  Database db;
};

/// Base of every part of the embedded store: each public call locks the mutex once. The parts share the connection, so
/// a transaction of one may change rows of others through their row functions (sqlite_models.h and so on).
class SqlitePart {
 public:
  /// The connection must outlive this object.
  explicit SqlitePart(SqliteConnection& connection) : mutex_(connection.mutex), db_(connection.db) {}

 protected:
  std::mutex& mutex_;
  Database& db_;
};

}  // namespace semblante::store
