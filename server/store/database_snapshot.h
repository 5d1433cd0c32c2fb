#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/types/result.h"
#include "server/store/records.h"

namespace semblante::store {

/// A blob that records refer to.
struct ReferencedBlob {
  std::optional<std::uint64_t> bytes;  ///< as recorded; empty: no record has its size
  std::set<std::string> users;         ///< "model <id>", "job <id>"
};

/// What a database of this version says about the files beside it, at one moment.
struct DatabaseSnapshot {
  std::map<std::string, ReferencedBlob> blobs;        ///< by SHA-256; as ArtefactStore::referenced_hashes()
  std::map<std::string, RecordingRecord> recordings;  ///< by id
  std::vector<std::string> damage;                    ///< as SQLite words it; empty: none was found
  std::vector<std::string> references;                ///< rows that refer to missing rows
};

/// How much of the database is read.
enum class Reading {
  records,     ///< the facts only
  everything,  ///< every page: `PRAGMA integrity_check` and `foreign_key_check`
};

/// Reads a database, also one that a server is using, and changes nothing. Errors: missing (there is no file),
/// malformed (it is damaged), io (it cannot be opened or read, e.g. while a server on a full disk uses it alone), both
/// with SQLite's words, unsupported (another version of the schema).
Result<DatabaseSnapshot> read_database(const std::filesystem::path& file, Reading reading);

/// Whether a server of this version would open the database; changes nothing. Errors: missing, malformed (damaged, or
/// of another program), io, unsupported (a later version of the schema).
Status check_opens(const std::filesystem::path& file);

/// Copies a database as it is at one moment, also while a server writes to it (SQLite's online backup), and makes the
/// copy durable. `to` must not exist. Errors as read_database(). Throws StoreError when `to` cannot be written.
Status copy_database(const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace semblante::store
