#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/types/result.h"

namespace semblante::upkeep {

/// What can be wrong with a data folder.
enum class FaultKind {
  damaged_database,   ///< SQLite's own check, or it cannot be read at all
  missing_row,        ///< a row refers to one that does not exist
  missing_blob,       ///< a record refers to it
  damaged_blob,       ///< its bytes do not have the SHA-256 of its name, or not the recorded size
  missing_recording,  ///< the database knows it
  damaged_recording,  ///< it cannot be read to its end, or has other frames than its record says
  unknown_blob,       ///< no record refers to it
  unknown_recording,  ///< the database does not know it
};
/// "damaged-database" and so on: stable, in the JSON form.
std::string_view to_string(FaultKind kind);

struct Fault {
  FaultKind kind;
  std::string name;    ///< the SHA-256 or the id; empty: of the database
  std::string detail;  ///< in words
};

struct CheckReport {
  bool server_runs = false;  ///< a server used the folder before or after the check
  std::uint64_t blobs = 0, blob_bytes = 0, recordings = 0, recording_bytes = 0;  ///< that were read and are intact
  std::vector<Fault> faults;
  std::vector<std::string> notes;                  ///< unusual, and no fault
  std::uint64_t moved_to_trash = 0, put_back = 0;  ///< files, by a repair
};

/// Compares the files of a data folder with its database, and reads all of them. Changes nothing, so a server may use
/// the folder meanwhile: a file that is added or removed during the check is not a fault, and a file that the database
/// does not know yet is only a note. Errors: missing (no folder, no database), unsupported (a database of another
/// version), io.
Result<CheckReport> check_data(const std::filesystem::path& data);

/// The same after what a start of the server does first: files that the database does not know go to the trash, and
/// files that it knows come back from there. Error also: mismatch, when a server runs.
Result<CheckReport> repair_data(const std::filesystem::path& data);

/// The report in lines for people, and as JSON.
std::string to_text(const CheckReport& report);
std::string to_json(const CheckReport& report);

}  // namespace semblante::upkeep
