#include "server/store/sqlite_artefacts.h"

namespace semblante::store {
namespace {

ArtefactRecord read_artefact(const Statement& row) { return {row.text(0), row.text(1), row.whole(2), row.text(3)}; }

std::optional<ArtefactRecord> read_first(Statement& statement) {
  if (!statement.step()) return std::nullopt;
  return read_artefact(statement);
}

/// The first column of every row.
std::vector<std::string> read_texts(Statement& statement) {
  std::vector<std::string> texts;
  while (statement.step()) texts.push_back(statement.text(0));
  return texts;
}

}  // namespace

void insert_artefact(Database& db, std::string_view model, const ArtefactRecord& artefact, bool of_package) {
  Statement(db, "INSERT OR REPLACE INTO artefacts VALUES(?,?,?,?,?,?)")
      .bind(model, artefact.name, artefact.sha256, artefact.bytes, artefact.content_type, of_package ? 1 : 0)
      .run();
}

std::optional<ArtefactRecord> find_artefact(Database& db, std::string_view model, std::string_view name) {
  Statement statement(db, "SELECT name, sha256, bytes, content_type FROM artefacts WHERE model = ? AND name = ?");
  statement.bind(model, name);
  return read_first(statement);
}

std::optional<ArtefactRecord> find_public_artefact(Database& db, std::string_view sha256) {
  Statement statement(db,
                      "SELECT name, sha256, bytes, content_type FROM artefacts WHERE sha256 = ? "
                      "AND name NOT IN ('source', 'positions') LIMIT 1");
  statement.bind(sha256);
  return read_first(statement);
}

std::vector<ArtefactRecord> list_artefacts(Database& db, std::string_view model) {
  std::vector<ArtefactRecord> list;
  Statement statement(db, "SELECT name, sha256, bytes, content_type FROM artefacts WHERE model = ? ORDER BY name");
  statement.bind(model);
  while (statement.step()) list.push_back(read_artefact(statement));
  return list;
}

std::vector<std::string> hashes_of(Database& db, std::string_view model) {
  Statement statement(db,
                      "SELECT sha256 FROM artefacts WHERE model = ? "
                      "UNION SELECT f.sha256 FROM job_files f JOIN jobs j ON j.id = f.job WHERE j.model = ?");
  statement.bind(model, model);
  return read_texts(statement);
}

std::vector<std::string> all_hashes(Database& db) {
  // A job that has ended does not need its files, even if the process was killed before they were removed.
  Statement statement(db,
                      "SELECT sha256 FROM artefacts UNION SELECT sha256 FROM speech_files "
                      "UNION SELECT f.sha256 FROM job_files f JOIN jobs j ON j.id = f.job WHERE j.state IN (0, 1)");
  return read_texts(statement);
}

std::vector<std::string> users_of_hash(Database& db, std::string_view sha256) {
  Statement statement(db,
                      "SELECT 'model ' || model FROM artefacts WHERE sha256 = ? "
                      "UNION SELECT 'speech ' || speech FROM speech_files WHERE sha256 = ? "
                      "UNION SELECT 'job ' || job FROM job_files WHERE sha256 = ?");
  statement.bind(sha256, sha256, sha256);
  return read_texts(statement);
}

std::vector<std::string> without_reference(Database& db, const std::vector<std::string>& hashes) {
  std::vector<std::string> orphans;
  for (const auto& hash : hashes) {
    Statement statement(db,
                        "SELECT 1 FROM artefacts WHERE sha256 = ? UNION SELECT 1 FROM job_files WHERE sha256 = ? "
                        "UNION SELECT 1 FROM speech_files WHERE sha256 = ? LIMIT 1");
    statement.bind(hash, hash, hash);
    if (!statement.step()) orphans.push_back(hash);
  }
  return orphans;
}

}  // namespace semblante::store
