#pragma once

#include <vector>

#include "server/store/records.h"
#include "server/store/sqlite.h"

// Rows of streams: one column for each setting, with the setting's name. Callers hold the store's mutex.
namespace semblante::store {

/// False when the id is taken.
bool insert_stream(Database& db, const StreamRecord& stream);
/// All, oldest first.
std::vector<StreamRecord> list_streams(Database& db);

}  // namespace semblante::store
