#include "server/store/store_error.h"

#include <cerrno>
#include <cstring>

#include <sys/stat.h>

namespace semblante::store {

std::string reason_of(const std::filesystem::path& path, int error_number) {
  const bool may_be_another = error_number == ENXIO || error_number == ELOOP || error_number == EISDIR ||
                              error_number == ENOTDIR || error_number == EEXIST;
  struct stat facts {};
  if (!may_be_another || ::lstat(path.c_str(), &facts) != 0) return std::strerror(error_number);
  const auto* found = S_ISFIFO(facts.st_mode)                            ? "a FIFO"
                      : S_ISSOCK(facts.st_mode)                          ? "a socket"
                      : S_ISCHR(facts.st_mode) || S_ISBLK(facts.st_mode) ? "a device"
                      : S_ISLNK(facts.st_mode)                           ? "a symbolic link"
                      : S_ISDIR(facts.st_mode) && error_number == EISDIR ? "a folder"
                      : S_ISREG(facts.st_mode) && error_number != EISDIR ? "a file"
                                                                         : nullptr;
  return found != nullptr ? std::string(found) + " is in its place" : std::strerror(error_number);
}

bool is_disk_full(int error_number) { return error_number == ENOSPC || error_number == EDQUOT; }

void throw_if_disk_full(const std::filesystem::path& path, int error_number) {
  if (is_disk_full(error_number)) throw DiskFull(path.string() + ": " + reason_of(path, error_number));
}

void throw_store_error(const std::filesystem::path& path, int error_number) {
  throw_if_disk_full(path, error_number);
  throw StoreError(path.string() + ": " + reason_of(path, error_number));
}

}  // namespace semblante::store
