#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/types/result.h"

namespace semblante::upkeep {

struct BackupReport {
  std::uint64_t blobs = 0, blob_bytes = 0, recordings = 0, recording_bytes = 0;  ///< copied, or put in place
  bool home_certificate = false;  ///< that of `serve --lan` was copied, with its key
  /// Files that the database knows and that could not be copied whole: "blob <SHA-256>: <reason>".
  std::vector<std::string> faults;
};

/// Copies a data folder, also while a server works in it, to a folder that is missing or empty. The copy is as the data
/// folder was at one moment of the call, and durable when this returns. Errors: missing (no database), mismatch (the
/// folder is not empty), malformed (a damaged database), unsupported (a database of another version), io. Throws
/// store::StoreError.
Result<BackupReport> back_up(const std::filesystem::path& data, const std::filesystem::path& to);

/// Makes a data folder of a backup, in a folder that is missing or empty, and compares the bytes of every blob with its
/// name. Errors: missing (no backup, or one that was not completed), mismatch (the folder is not empty), io. Throws
/// store::StoreError.
Result<BackupReport> restore(const std::filesystem::path& backup, const std::filesystem::path& data);

/// In lines for people.
std::string to_text(const BackupReport& report);

}  // namespace semblante::upkeep
