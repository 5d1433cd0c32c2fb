#pragma once

// Private to store/: the tables, and how a file gets those of this version.

#include "core/types/result.h"
#include "server/store/sqlite.h"

namespace semblante::store {

/// Brings a file of any earlier version, or an empty one, to this version's tables. `unsupported` when a later version
/// wrote it.
Status bring_up_to_date(Database& db);
/// Writes the version down (again).
void set_schema_version(Database& db);

}  // namespace semblante::store
