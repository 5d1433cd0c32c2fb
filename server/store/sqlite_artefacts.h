#pragma once

// Private to store/: rows of artefacts, and which blobs they refer to. Within the caller's transaction.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "server/store/records.h"
#include "server/store/sqlite.h"

namespace semblante::store {

/// Replaces an artefact of the same name.
void insert_artefact(Database& db, std::string_view model, const ArtefactRecord& artefact, bool of_package);
std::optional<ArtefactRecord> find_artefact(Database& db, std::string_view model, std::string_view name);
/// An artefact that clients may fetch by its hash.
std::optional<ArtefactRecord> find_public_artefact(Database& db, std::string_view sha256);
std::vector<ArtefactRecord> list_artefacts(Database& db, std::string_view model);

std::vector<std::string> hashes_of(Database& db, std::string_view model);
std::vector<std::string> all_hashes(Database& db);
/// As ArtefactStore::users_of.
std::vector<std::string> users_of_hash(Database& db, std::string_view sha256);
/// The hashes that no record refers to.
std::vector<std::string> without_reference(Database& db, const std::vector<std::string>& hashes);

}  // namespace semblante::store
