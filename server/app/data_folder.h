#pragma once

#include <filesystem>

#include "server/store/store.h"
#include "server/store/trash.h"

namespace semblante {

/// Before the database is opened: SQLite deletes the commit log (-wal) of a database file that is gone or empty, so it
/// goes into the trash. It is what makes that file whole if somebody brings it back.
void keep_log_of_lost_database(const std::filesystem::path& data, store::Trash& trash);

/// After it is opened and before anybody works with it: brings the files of the data folder in line with it. What it
/// does not know goes into the trash, what it knows comes back from there; the log says so, as a warning where the
/// database is new, another or older than the one that worked here last, and names what is missing.
void bring_files_in_line(const std::filesystem::path& data, store::Store& store, store::Trash& trash);

}  // namespace semblante
