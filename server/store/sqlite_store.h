#pragma once

#include <filesystem>
#include <memory>

#include "core/types/result.h"
#include "server/store/store.h"

namespace semblante::store {

/// Opens or creates the store in one SQLite file: WAL, synchronous=FULL, so that a commit is durable when it returns.
/// One connection behind one mutex. Error `io` with the path when it cannot be opened, `unsupported` when it was
/// written by a later version. Throws DiskFull when it cannot be created or migrated on a full disk; a file of this
/// version can be opened on a full disk.
Result<std::unique_ptr<Store>> open_sqlite_store(const std::filesystem::path& file);

}  // namespace semblante::store
