#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "server/store/records.h"
#include "server/store/sqlite.h"

// Rows of recordings. Callers hold the store's mutex.
namespace semblante::store {

void insert_recording(Database& db, const RecordingRecord& recording);
std::optional<RecordingRecord> find_recording(Database& db, std::string_view id);
std::optional<RecordingRecord> find_newest_recording(Database& db, std::string_view stream);
/// As Store::recordings.
std::optional<std::vector<RecordingRecord>> list_recordings(Database& db, std::string_view stream,
                                                            std::string_view after, std::size_t limit);
void write_recording(Database& db, const RecordingRecord& recording);

}  // namespace semblante::store
