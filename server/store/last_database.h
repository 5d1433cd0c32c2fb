#pragma once

#include <filesystem>
#include <optional>

#include "core/types/result.h"
#include "server/store/records.h"

namespace semblante::store {

/// Which database a server worked with last in a data folder: the file `last-database` there, one line. So a start can
/// tell a database that is new here, another one, and an older copy. nullopt when there is none that can be read.
std::optional<DatabaseIdentity> read_last_database(const std::filesystem::path& data);
/// Durable when it returns. Errors: io; the old one stays then.
Status write_last_database(const std::filesystem::path& data, const DatabaseIdentity& identity);

}  // namespace semblante::store
