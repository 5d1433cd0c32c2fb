#include "server/store/store_error.h"

#include <cerrno>
#include <cstring>

namespace semblante::store {

bool is_disk_full(int error_number) { return error_number == ENOSPC || error_number == EDQUOT; }

void throw_if_disk_full(const std::filesystem::path& path, int error_number) {
  if (is_disk_full(error_number)) throw DiskFull(path.string() + ": " + std::strerror(error_number));
}

void throw_store_error(const std::filesystem::path& path, int error_number) {
  throw_if_disk_full(path, error_number);
  throw StoreError(path.string() + ": " + std::strerror(error_number));
}

}  // namespace semblante::store
