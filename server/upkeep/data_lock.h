#pragma once

#include <filesystem>
#include <memory>

#include "core/types/result.h"
#include "server/store/descriptor.h"

namespace semblante::upkeep {

/// Holds the lock of a data folder. A server holds it while it runs. The destructor releases it.
class DataLock {
 public:
  /// Errors: `io` (the folder cannot be written), `mismatch` (another process holds the lock).
  static Result<std::unique_ptr<DataLock>> take(const std::filesystem::path& data);

 private:
  explicit DataLock(const std::filesystem::path& file);
  store::Descriptor file_;
};

/// Whether a server holds the lock of this folder.
bool is_server_running(const std::filesystem::path& data);

}  // namespace semblante::upkeep
