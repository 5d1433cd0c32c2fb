#include "server/store/sqlite_artefact_store.h"

#include <mutex>

#include "server/store/sqlite_artefacts.h"

namespace semblante::store {

std::optional<ArtefactRecord> SqliteArtefactStore::artefact(std::string_view model, std::string_view name) {
  const std::lock_guard lock(mutex_);
  return find_artefact(db_, model, name);
}

std::vector<ArtefactRecord> SqliteArtefactStore::artefacts(std::string_view model) {
  const std::lock_guard lock(mutex_);
  return list_artefacts(db_, model);
}

std::optional<ArtefactRecord> SqliteArtefactStore::public_artefact(std::string_view sha256) {
  const std::lock_guard lock(mutex_);
  return find_public_artefact(db_, sha256);
}

std::uint64_t SqliteArtefactStore::artefact_bytes() {
  const std::lock_guard lock(mutex_);
  Statement statement(
      db_,
      "SELECT CAST(total(bytes) AS INTEGER) FROM (SELECT sha256, bytes FROM artefacts UNION SELECT sha256, bytes FROM "
      "speech_files)");
  return statement.step() ? statement.whole(0) : 0;
}

std::vector<std::string> SqliteArtefactStore::referenced_hashes() {
  const std::lock_guard lock(mutex_);
  return all_hashes(db_);
}

std::vector<std::string> SqliteArtefactStore::users_of(std::string_view sha256) {
  const std::lock_guard lock(mutex_);
  return users_of_hash(db_, sha256);
}

}  // namespace semblante::store
