#include "server/store/sqlite_store.h"

#include <sqlite3.h>

#include "server/store/sqlite_artefact_store.h"
#include "server/store/sqlite_database_facts.h"
#include "server/store/sqlite_job_store.h"
#include "server/store/sqlite_key_store.h"
#include "server/store/sqlite_model_store.h"
#include "server/store/sqlite_owner_store.h"
#include "server/store/sqlite_recording_store.h"
#include "server/store/sqlite_schema.h"
#include "server/store/sqlite_set_store.h"
#include "server/store/sqlite_speech_store.h"
#include "server/store/sqlite_stream_store.h"
#include "server/store/sqlite_token_store.h"

namespace semblante::store {
namespace {

/// `exclusive` keeps the index of the write-ahead log in memory, because a full disk has no room for its file; other
/// programs cannot open the database meanwhile.
enum class Locking { shared, exclusive };

/// The parts, on one connection.
class SqliteStore final : private SqliteConnection,
                          public SqliteModelStore,
                          public SqliteArtefactStore,
                          public SqliteJobStore,
                          public SqliteSetStore,
                          public SqliteStreamStore,
                          public SqliteRecordingStore,
                          public SqliteSpeechStore,
                          public SqliteKeyStore,
                          public SqliteTokenStore,
                          public SqliteOwnerStore,
                          public SqliteDatabaseFacts,
                          public Store {
 public:
  SqliteStore(const std::string& file, Locking locking)
      : SqliteConnection(file),
        SqliteModelStore(connection()),
        SqliteArtefactStore(connection()),
        SqliteJobStore(connection()),
        SqliteSetStore(connection()),
        SqliteStreamStore(connection()),
        SqliteRecordingStore(connection()),
        SqliteSpeechStore(connection()),
        SqliteKeyStore(connection()),
        SqliteTokenStore(connection()),
        SqliteOwnerStore(connection()),
        SqliteDatabaseFacts(connection()) {
    if (locking == Locking::exclusive) db.execute("PRAGMA locking_mode=EXCLUSIVE");
  }

  Status prepare() {
    // First: a file of another program or of a later version is not changed, not even to another kind of journal.
    db.execute("BEGIN");
    auto checked = check_schema(db);
    db.execute("COMMIT");
    if (!checked) return checked;
    db.execute("PRAGMA journal_mode=WAL");
    // The file of the write-ahead log is kept, empty, at a shutdown, so that a start on a full disk does not need a new
    // one. The size limit empties it: a log with content would be applied to any database that replaces this one.
    int persist = 1;
    sqlite3_file_control(db.get(), nullptr, SQLITE_FCNTL_PERSIST_WAL, &persist);
    db.execute("PRAGMA journal_size_limit=16777216");
    db.execute("PRAGMA temp_store=MEMORY");
    db.execute("PRAGMA synchronous=FULL");
    db.execute("PRAGMA foreign_keys=ON");
    return bring_up_to_date(db);
  }

 private:
  SqliteConnection& connection() { return *this; }
};

Result<std::unique_ptr<Store>> open_with(const std::filesystem::path& file, Locking locking) {
  auto store = std::make_unique<SqliteStore>(file.string(), locking);
  if (auto prepared = store->prepare(); !prepared)
    return Error{prepared.error().code, file.string(), prepared.error().message};
  return Result<std::unique_ptr<Store>>(std::move(store));
}

}  // namespace

Result<std::unique_ptr<Store>> open_sqlite_store(const std::filesystem::path& file) {
  try {
    try {
      return open_with(file, Locking::shared);
    } catch (const BusyDatabase&) {
      throw;
    } catch (const StoreError&) {
      return open_with(file, Locking::exclusive);
    }
  } catch (const DiskFull&) {
    throw;
  } catch (const DamagedDatabase& fault) {
    return Error{ErrorCode::malformed, file.string(),
                 "it is no database, or a damaged one (" + std::string(fault.what()) +
                     "); put a backup in its place, or move it away to begin without what it knows"};
  } catch (const BusyDatabase&) {
    return Error{ErrorCode::io, file.string(), "another program has it open and holds it"};
  } catch (const std::exception& fault) {
    const std::string what = fault.what();
    return Error{ErrorCode::io, what.starts_with(file.string()) ? std::string() : file.string(), what};
  }
}

}  // namespace semblante::store
