#include "tests/support/failing_database.h"

#include <atomic>
#include <map>
#include <mutex>
#include <sqlite3.h>

namespace semblante::test {
namespace {

std::atomic<int> write_code{SQLITE_OK};

/// SQLite's own methods of an open file, but for write.
struct Methods {
  sqlite3_io_methods ours;
  const sqlite3_io_methods* theirs;
};

std::map<const sqlite3_io_methods*, Methods>& all_methods() {
  static std::map<const sqlite3_io_methods*, Methods> all;
  return all;
}
std::mutex methods_mutex;

int write(sqlite3_file* file, const void* bytes, int size, sqlite3_int64 offset) {
  if (const int code = write_code; code != SQLITE_OK) return code;
  const auto* methods = reinterpret_cast<const Methods*>(file->pMethods);
  return methods->theirs->xWrite(file, bytes, size, offset);
}

sqlite3_vfs* system_files = nullptr;

int open(sqlite3_vfs*, const char* name, sqlite3_file* file, int flags, int* out_flags) {
  const int code = system_files->xOpen(system_files, name, file, flags, out_flags);
  if (code != SQLITE_OK || file->pMethods == nullptr) return code;
  const std::lock_guard lock(methods_mutex);
  const auto [found, is_new] = all_methods().try_emplace(file->pMethods, Methods{*file->pMethods, file->pMethods});
  if (is_new) found->second.ours.xWrite = write;
  file->pMethods = &found->second.ours;
  return SQLITE_OK;
}

/// Every database that is opened from now on is under it.
struct Registration {
  sqlite3_vfs files;
  Registration() : files(*sqlite3_vfs_find(nullptr)) {
    system_files = sqlite3_vfs_find(nullptr);
    files.zName = "semblante-test";
    files.pNext = nullptr;
    files.xOpen = open;
    sqlite3_vfs_register(&files, 1);
  }
};

}  // namespace

void fail_database_writes(int sqlite_code) {
  static const Registration registration;
  write_code = sqlite_code;
}

FullDatabaseDisk::FullDatabaseDisk() { fail_database_writes(SQLITE_FULL); }
FullDatabaseDisk::~FullDatabaseDisk() { fail_database_writes(SQLITE_OK); }

}  // namespace semblante::test
