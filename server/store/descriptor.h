#pragma once

// File operations for the data folder that std::filesystem does not have.

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <string>
#include <unistd.h>

#include "core/types/result.h"

namespace semblante::store {

/// A file descriptor, closed by the destructor.
class Descriptor {
 public:
  Descriptor(const std::filesystem::path& path, int flags) : value_(::open(path.c_str(), flags | O_CLOEXEC, 0600)) {}
  ~Descriptor() {
    if (value_ >= 0) ::close(value_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  [[nodiscard]] bool ok() const { return value_ >= 0; }
  [[nodiscard]] int get() const { return value_; }

 private:
  int value_;
};

/// Makes names that were added to the folder or removed from it durable.
inline bool sync_folder(const std::filesystem::path& folder) {
  const Descriptor descriptor(folder, O_RDONLY | O_DIRECTORY);
  return descriptor.ok() && ::fsync(descriptor.get()) == 0;
}

/// The error of a system call on `path` that set this errno.
inline Error io_error(const std::filesystem::path& path, int error_number = errno) {
  return {ErrorCode::io, path.string(), path.string() + ": " + std::strerror(error_number)};
}

}  // namespace semblante::store
