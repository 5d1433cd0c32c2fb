#include "server/upkeep/data_lock.h"

#include <cerrno>
#include <utility>

#include <sys/file.h>

namespace semblante::upkeep {
namespace {

constexpr const char* lock_name = "lock";

}  // namespace

DataLock::DataLock(const std::filesystem::path& file) : file_(file, O_RDWR | O_CREAT) {}

Result<std::unique_ptr<DataLock>> DataLock::take(const std::filesystem::path& data) {
  std::unique_ptr<DataLock> lock(new DataLock(data / lock_name));
  if (!lock->file_.ok()) return store::io_error(data / lock_name);
  if (::flock(lock->file_.get(), LOCK_EX | LOCK_NB) != 0)
    return Error{ErrorCode::mismatch, "", "another process holds the lock"};
  return Result<std::unique_ptr<DataLock>>(std::move(lock));
}

bool is_server_running(const std::filesystem::path& data) {
  const store::Descriptor file(data / lock_name, O_RDONLY);
  // Shared: two checks do not take each other for a server, and a start that comes just now tries again.
  return file.ok() && ::flock(file.get(), LOCK_SH | LOCK_NB) != 0;
}

}  // namespace semblante::upkeep
