#pragma once

#include <filesystem>
#include <optional>

#include "core/types/result.h"
#include "server/store/records.h"

namespace semblante::store {

/// The identity of the database that a server last used in a data folder: one line in its file `last-database`. With
/// it, a start recognizes a new database, a different one, and an older copy. nullopt when the file is missing or not
/// readable.
std::optional<DatabaseIdentity> read_last_database(const std::filesystem::path& data);
/// Durable when it returns. Errors: io; the old identity is kept then.
Status write_last_database(const std::filesystem::path& data, const DatabaseIdentity& identity);

}  // namespace semblante::store
