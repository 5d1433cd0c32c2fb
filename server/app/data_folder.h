#pragma once

#include <filesystem>

#include "server/store/store.h"
#include "server/store/trash.h"

namespace semblante {

/// To be called before the database is opened. SQLite deletes the write-ahead log (-wal) of a missing or empty database
/// file, so the log is moved into the trash: it completes that file if it is restored.
void keep_log_of_lost_database(const std::filesystem::path& data, store::Trash& trash);

/// To be called after the database is opened and before other threads use it: reconciles the files of the data folder
/// with it. Unknown files are moved into the trash, known files back from there. Logs this, as a warning if the
/// database is new, different from or older than the one last used here, and names missing files.
void bring_files_in_line(const std::filesystem::path& data, store::Store& store, store::Trash& trash);

}  // namespace semblante
