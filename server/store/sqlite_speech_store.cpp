#include "server/store/sqlite_speech_store.h"

#include <mutex>

#include <nlohmann/json.hpp>

#include "server/store/sqlite_artefacts.h"
#include "server/store/sqlite_keys.h"

namespace semblante::store {
namespace {

constexpr const char* speech_columns =
    "SELECT id, created, request, text, voice, duration, warnings, owner FROM speeches ";

SpeechRecord read_speech(Database& db, const Statement& row) {
  SpeechRecord speech{row.text(0), row.text(1), row.json(2), row.text(3), row.text(4), row.whole(5)};
  speech.warnings = row.texts(6);
  speech.owner = row.text(7);
  Statement files(db, "SELECT name, sha256, bytes, content_type FROM speech_files WHERE speech = ? ORDER BY name");
  files.bind(speech.id);
  while (files.step()) speech.files.push_back({files.text(0), files.text(1), files.whole(2), files.text(3)});
  return speech;
}

}  // namespace

void SqliteSpeechStore::create_speech(const SpeechRecord& speech, const std::optional<IdempotencyRecord>& key) {
  const std::lock_guard lock(mutex_);
  Transaction transaction(db_);
  Statement(db_, "INSERT INTO speeches VALUES(NULL,?,?,?,?,?,?,?,?)")
      .bind(speech.id, speech.created, speech.request, speech.text, speech.voice, speech.duration,
            nlohmann::json(speech.warnings).dump(), speech.owner)
      .run();
  for (const ArtefactRecord& file : speech.files)
    Statement(db_, "INSERT INTO speech_files VALUES(?,?,?,?,?)")
        .bind(speech.id, file.name, file.sha256, file.bytes, file.content_type)
        .run();
  insert_key(db_, key);
  transaction.commit();
}

std::optional<SpeechRecord> SqliteSpeechStore::speech(std::string_view id) {
  const std::lock_guard lock(mutex_);
  Statement statement(db_, std::string(speech_columns) + "WHERE id = ?");
  statement.bind(id);
  if (!statement.step()) return std::nullopt;
  return read_speech(db_, statement);
}

std::optional<std::vector<SpeechRecord>> SqliteSpeechStore::speeches(std::string_view after, std::size_t limit) {
  const std::lock_guard lock(mutex_);
  std::int64_t number = 0;
  if (!after.empty()) {
    Statement statement(db_, "SELECT number FROM speeches WHERE id = ?");
    statement.bind(after);
    if (!statement.step()) return std::nullopt;
    number = statement.integer(0);
  }
  std::vector<SpeechRecord> list;
  Statement statement(db_, std::string(speech_columns) + "WHERE number > ? ORDER BY number LIMIT ?");
  statement.bind(number, static_cast<std::uint64_t>(limit));
  while (statement.step()) list.push_back(read_speech(db_, statement));
  return list;
}

std::size_t SqliteSpeechStore::speech_count() {
  const std::lock_guard lock(mutex_);
  Statement statement(db_, "SELECT count(*) FROM speeches");
  statement.step();
  return static_cast<std::size_t>(statement.integer(0));
}

std::optional<std::vector<std::string>> SqliteSpeechStore::remove_speech(std::string_view id) {
  const std::lock_guard lock(mutex_);
  Transaction transaction(db_);
  std::vector<std::string> hashes;
  {
    Statement files(db_, "SELECT DISTINCT sha256 FROM speech_files WHERE speech = ?");
    files.bind(id);
    while (files.step()) hashes.push_back(files.text(0));
  }
  Statement(db_, "DELETE FROM speeches WHERE id = ?").bind(id).run();
  if (db_.changes() == 0) return std::nullopt;
  auto orphans = without_reference(db_, hashes);
  transaction.commit();
  return orphans;
}

}  // namespace semblante::store
