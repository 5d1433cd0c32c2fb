#pragma once

// Private to store/: the tables, and the migrations from earlier versions.

#include "core/types/result.h"
#include "server/store/sqlite.h"

namespace semblante::store {

/// Whether bring_up_to_date() would take the file, as of the transaction in which it is called.
Status check_schema(Database& db);
/// Migrates a file of any earlier version, or an empty one, to the tables of this version. Errors: `unsupported` (a
/// later version wrote it), `malformed` (another program did).
Status bring_up_to_date(Database& db);
/// The version of the tables that this program makes.
int current_schema_version();
/// The version in the file; 0: it is empty.
int schema_version_of(Database& db);
/// Writes the schema version of this program into the file.
void set_schema_version(Database& db);

}  // namespace semblante::store
