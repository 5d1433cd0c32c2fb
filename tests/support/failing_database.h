#pragma once

namespace semblante::test {

/// What SQLite's files say to every write of this process while it is set: SQLITE_FULL for a full disk,
/// SQLITE_IOERR_WRITE for a broken one, 0 for none. The first call must come before the first database is opened.
void fail_database_writes(int sqlite_code);

/// A full disk under the databases of this process while it exists.
class FullDatabaseDisk {
 public:
  FullDatabaseDisk();
  ~FullDatabaseDisk();
  FullDatabaseDisk(const FullDatabaseDisk&) = delete;
  FullDatabaseDisk& operator=(const FullDatabaseDisk&) = delete;
};

}  // namespace semblante::test
