#pragma once

#include <filesystem>
#include <memory>

#include "server/store/descriptor.h"

namespace semblante::upkeep {

/// The lock of a data folder, which a running server holds. Released by the destructor.
class DataLock {
 public:
  /// nullptr when a server holds it, or the folder cannot be written.
  static std::unique_ptr<DataLock> take(const std::filesystem::path& data);

 private:
  explicit DataLock(const std::filesystem::path& file);
  store::Descriptor file_;
};

/// Whether a server holds the lock of this folder.
bool is_server_running(const std::filesystem::path& data);

}  // namespace semblante::upkeep
