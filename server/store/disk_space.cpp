#include "server/store/disk_space.h"

#include <fcntl.h>
#include <system_error>
#include <unistd.h>

#include <sys/statvfs.h>

#include "server/store/store_error.h"

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
  const auto size = std::filesystem::file_size(file_, error);
  return !error && size == bytes_;
}

bool DiskReserve::release() {
  const std::lock_guard lock(mutex_);
  return is_full() && ::truncate(file_.c_str(), 0) == 0;
}

void DiskReserve::fill() {
  const std::lock_guard lock(mutex_);
  if (is_full()) return;
  const int descriptor = ::open(file_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  int fault = descriptor < 0 ? errno : ::posix_fallocate(descriptor, 0, static_cast<off_t>(bytes_));
  if (descriptor >= 0 && fault != 0 && ::ftruncate(descriptor, 0) != 0) fault = errno;
  if (descriptor >= 0) ::close(descriptor);
  if (fault != 0) throw_store_error(file_, fault);
}

}  // namespace semblante::store
