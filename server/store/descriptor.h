#pragma once

// File operations for the data folder that std::filesystem does not have.

#include <cerrno>
#include <fcntl.h>
#include <filesystem>
#include <unistd.h>

#include <sys/stat.h>

#include "core/types/result.h"
#include "server/store/store_error.h"

namespace semblante::store {

/// A file descriptor, closed by the destructor: of a folder with O_DIRECTORY, else of a regular file. Anything else of
/// that name is not opened, because opening a FIFO or a device may block and a symbolic link leads elsewhere;
/// reason_of() says what it is.
class Descriptor {
 public:
  Descriptor(const std::filesystem::path& path, int flags) {
    const bool is_folder = (flags & O_DIRECTORY) != 0;
    value_ = ::open(path.c_str(), flags | O_CLOEXEC | (is_folder ? 0 : O_NOFOLLOW | O_NONBLOCK), 0600);
    if (!ok() || is_folder) return;
    struct stat facts {};
    if (::fstat(value_, &facts) == 0 && S_ISREG(facts.st_mode)) return;
    ::close(value_);
    value_ = -1;
    errno = S_ISDIR(facts.st_mode) ? EISDIR : ENXIO;
  }
  ~Descriptor() {
    if (ok()) ::close(value_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  [[nodiscard]] bool ok() const { return value_ >= 0; }
  [[nodiscard]] int get() const { return value_; }

 private:
  int value_ = -1;
};

/// Makes names that were added to the folder or removed from it durable.
inline bool sync_folder(const std::filesystem::path& folder) {
  const Descriptor descriptor(folder, O_RDONLY | O_DIRECTORY);
  return descriptor.ok() && ::fsync(descriptor.get()) == 0;
}

/// The error of a system call on `path` that set this errno.
inline Error io_error(const std::filesystem::path& path, int error_number = errno) {
  return {ErrorCode::io, path.string(), path.string() + ": " + reason_of(path, error_number)};
}

}  // namespace semblante::store
