#include "server/store/database_snapshot.h"

#include <memory>
#include <system_error>

#include "server/store/data_files.h"
#include "server/store/descriptor.h"
#include "server/store/sqlite.h"
#include "server/store/sqlite_jobs.h"
#include "server/store/sqlite_models.h"
#include "server/store/sqlite_recordings.h"
#include "server/store/sqlite_schema.h"
#include "server/store/sqlite_sets.h"
#include "server/store/sqlite_streams.h"
#include "server/store/store_error.h"

namespace semblante::store {
namespace {

namespace fs = std::filesystem;

bool has_log(const fs::path& file) {
  std::error_code error;
  const auto bytes = fs::file_size(file.string() + "-wal", error);
  return !error && bytes > 0;
}

/// A reader of a write-ahead log needs the index beside it, which cannot be made in a folder that is read only.
std::unique_ptr<Database> open_to_read(const fs::path& file) {
  auto database = std::make_unique<Database>(file.string(), Access::read_only);
  try {
    Statement(*database, "SELECT count(*) FROM sqlite_master").run();
    return database;
  } catch (const DamagedDatabase&) {
    throw;
  } catch (const StoreError&) {
    if (has_log(file) || ::access(file.parent_path().c_str(), W_OK) == 0) throw;
  }
  return std::make_unique<Database>(file.string(), Access::immutable);
}

std::vector<std::string> check_pages(Database& db) {
  std::vector<std::string> faults;
  Statement statement(db, "PRAGMA integrity_check");
  while (statement.step())
    if (auto line = statement.text(0); line != "ok") faults.push_back(std::move(line));
  return faults;
}

std::vector<std::string> check_references(Database& db) {
  std::vector<std::string> faults;
  Statement statement(db, "PRAGMA foreign_key_check");
  while (statement.step())
    faults.push_back("a row of " + statement.text(0) + " refers to a missing row of " + statement.text(2));
  return faults;
}

/// The first value of each kind of record that no statement of this program writes.
std::vector<std::string> check_values(Database& db) {
  std::vector<std::string> faults;
  const auto reads = [&faults](const auto& read) {
    try {
      read();
    } catch (const DamagedDatabase& fault) {
      faults.emplace_back(fault.what());
    }
  };
  reads([&] {
    const auto models = list_models(db, "", INT64_MAX);
    for (const auto& model : *models) static_cast<void>(read_points(db, model.id));
  });
  reads([&] { static_cast<void>(list_unfinished_jobs(db)); });
  reads([&] { static_cast<void>(list_streams(db)); });
  reads([&] { static_cast<void>(list_sets(db, "", INT64_MAX)); });
  return faults;
}

std::map<std::string, ReferencedBlob> read_blobs(Database& db) {
  std::map<std::string, ReferencedBlob> blobs;
  {
    Statement statement(db,
                        "SELECT sha256, bytes, 'model ' || model FROM artefacts "
                        "UNION ALL SELECT sha256, bytes, 'speech ' || speech FROM speech_files");
    while (statement.step()) {
      auto& blob = blobs[statement.text(0)];
      blob.bytes = statement.whole(1);
      blob.users.insert(statement.text(2));
    }
  }
  // As all_hashes() of sqlite_artefacts.cpp: a job that has ended does not need its files.
  Statement statement(db,
                      "SELECT f.sha256, f.job FROM job_files f JOIN jobs j ON j.id = f.job WHERE j.state IN (0, 1)");
  while (statement.step()) blobs[statement.text(0)].users.insert("job " + statement.text(1));
  return blobs;
}

Error not_there(const fs::path& file) {
  return {ErrorCode::missing, file.string(), "there is no " + file.filename().string() + " in the data folder"};
}

/// Runs `work` with SQLite's faults as errors.
template <class T, class Work>
Result<T> reading(const fs::path& file, const Work& work) {
  try {
    return work();
  } catch (const DiskFull&) {
    throw;
  } catch (const DamagedDatabase& fault) {
    return Error{ErrorCode::malformed, file.string(), fault.what()};
  } catch (const std::exception& fault) {
    return Error{ErrorCode::io, file.string(), fault.what()};
  }
}

}  // namespace

Result<DatabaseSnapshot> read_database(const fs::path& file, Reading how) {
  if (!is_real_file(file)) return not_there(file);
  return reading<DatabaseSnapshot>(file, [&]() -> Result<DatabaseSnapshot> {
    const auto db = open_to_read(file);
    db->execute("BEGIN");  // everything is read as of one moment
    const int version = schema_version_of(*db);
    if (version != current_schema_version())
      return Error{ErrorCode::unsupported, file.string(),
                   "the database has version " + std::to_string(version) + " of the schema, this program reads " +
                       std::to_string(current_schema_version()) +
                       (version < current_schema_version() ? ": start the server once, which migrates it"
                                                           : ": use the later program")};
    DatabaseSnapshot snapshot;
    if (how == Reading::everything) {
      snapshot.damage = check_pages(*db);
      if (snapshot.damage.empty()) snapshot.damage = check_values(*db);
      snapshot.references = check_references(*db);
    }
    snapshot.blobs = read_blobs(*db);
    const auto recordings = list_recordings(*db, "", "", INT64_MAX);
    for (const auto& record : *recordings) snapshot.recordings.emplace(record.id, record);
    return snapshot;
  });
}

Status check_opens(const fs::path& file) {
  if (!is_real_file(file)) return not_there(file);
  return reading<Unit>(file, [&]() -> Result<Unit> {
    const auto db = open_to_read(file);
    db->execute("BEGIN");  // the version and the tables are of one moment
    auto checked = check_schema(*db);
    if (checked) return Unit{};
    return Error{checked.error().code, file.string(), checked.error().message};
  });
}

Status copy_database(const fs::path& from, const fs::path& to) {
  if (!is_real_file(from)) return not_there(from);
  const auto copied = reading<Unit>(from, [&]() -> Result<Unit> {
    const auto source = open_to_read(from);
    Database copy(to.string());
    copy.execute("PRAGMA synchronous=FULL");
    sqlite3_backup* backup = sqlite3_backup_init(copy.get(), "main", source->get(), "main");
    if (backup == nullptr) return Error{ErrorCode::io, to.string(), sqlite3_errmsg(copy.get())};
    // All pages in one step: a writer of the source would make a copy in several steps begin again.
    sqlite3_backup_step(backup, -1);
    const int code = sqlite3_backup_finish(backup);
    if (code == SQLITE_FULL) throw DiskFull(to.string() + ": " + sqlite3_errstr(code));
    if (code != SQLITE_OK) return Error{ErrorCode::io, from.string(), sqlite3_errstr(code)};
    // One file, without a log beside it.
    copy.execute("PRAGMA journal_mode=DELETE");
    return Unit{};
  });
  if (!copied) return copied.error();
  const Descriptor file(to, O_RDONLY);
  if (!file.ok() || ::fsync(file.get()) != 0 || !sync_folder(to.parent_path())) throw_store_error(to, errno);
  return Unit{};
}

}  // namespace semblante::store
