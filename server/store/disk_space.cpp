#include "server/store/disk_space.h"

#include <fcntl.h>
#include <system_error>
#include <unistd.h>

#include <sys/statvfs.h>

#include "server/store/data_files.h"
#include "server/store/descriptor.h"

namespace semblante::store {

std::uint64_t free_bytes(const std::filesystem::path& folder) {
  struct statvfs facts {};
  if (::statvfs(folder.c_str(), &facts) != 0) return UINT64_MAX;
  return static_cast<std::uint64_t>(facts.f_bavail) * facts.f_frsize;
}

std::uint64_t free_files(const std::filesystem::path& folder) {
  struct statvfs facts {};
  if (::statvfs(folder.c_str(), &facts) != 0 || facts.f_files == 0) return UINT64_MAX;
  return facts.f_favail;
}

DiskReserve::DiskReserve(std::filesystem::path file, std::uint64_t bytes) : file_(std::move(file)), bytes_(bytes) {}

bool DiskReserve::is_full() const {
  std::error_code error;
  return is_real_file(file_) && std::filesystem::file_size(file_, error) == bytes_ && !error;
}

bool DiskReserve::release() {
  const std::lock_guard lock(mutex_);
  return is_full() && ::truncate(file_.c_str(), 0) == 0;
}

void DiskReserve::fill() {
  const std::lock_guard lock(mutex_);
  if (is_full()) return;
  // Nobody's content: whatever else has the name goes. A folder stays, and is reported.
  if (!is_real_file(file_)) ::unlink(file_.c_str());
  const Descriptor file(file_, O_WRONLY | O_CREAT | O_TRUNC);
  int fault = file.ok() ? ::posix_fallocate(file.get(), 0, static_cast<off_t>(bytes_)) : errno;
  if (file.ok() && fault != 0 && ::ftruncate(file.get(), 0) != 0) fault = errno;
  if (fault != 0) throw_store_error(file_, fault);
}

}  // namespace semblante::store
