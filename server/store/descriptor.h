#pragma once

// Private to store/: what std::filesystem does not offer.

#include <fcntl.h>
#include <filesystem>
#include <unistd.h>

namespace semblante::store {

/// An open file, closed with the object.
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

/// Makes names that came into the folder or left it durable.
inline bool sync_folder(const std::filesystem::path& folder) {
  const Descriptor descriptor(folder, O_RDONLY | O_DIRECTORY);
  return descriptor.ok() && ::fsync(descriptor.get()) == 0;
}

}  // namespace semblante::store
