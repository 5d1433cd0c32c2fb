#include "server/store/sqlite_schema.h"

#include <array>
#include <string>

namespace semblante::store {
namespace {

/// Lists that are always read completely (parts, warnings, boxes) are one JSON column; values of queries have their own
/// columns.
constexpr const char* first_schema = R"sql(
CREATE TABLE models(
  number INTEGER PRIMARY KEY AUTOINCREMENT,
  id TEXT NOT NULL UNIQUE, name TEXT NOT NULL, state INTEGER NOT NULL, problem TEXT NOT NULL,
  created TEXT NOT NULL, updated TEXT NOT NULL, revision INTEGER NOT NULL,
  file_name TEXT NOT NULL, format TEXT NOT NULL, source_bytes INTEGER NOT NULL, source_sha256 TEXT NOT NULL,
  vertices INTEGER NOT NULL, triangles INTEGER NOT NULL, facts TEXT NOT NULL,
  points_revision INTEGER NOT NULL) STRICT;
CREATE TABLE packages(
  model TEXT PRIMARY KEY REFERENCES models(id) ON DELETE CASCADE,
  parametrization TEXT NOT NULL, created TEXT NOT NULL, metric TEXT NOT NULL, weights TEXT NOT NULL,
  weight_bits INTEGER NOT NULL) STRICT;
CREATE TABLE feature_points(
  model TEXT NOT NULL REFERENCES models(id) ON DELETE CASCADE, position INTEGER NOT NULL, id TEXT NOT NULL,
  vertex INTEGER, x REAL, y REAL, z REAL, PRIMARY KEY(model, id)) STRICT, WITHOUT ROWID;
CREATE TABLE artefacts(
  model TEXT NOT NULL REFERENCES models(id) ON DELETE CASCADE, name TEXT NOT NULL, sha256 TEXT NOT NULL,
  bytes INTEGER NOT NULL, content_type TEXT NOT NULL, of_package INTEGER NOT NULL,
  PRIMARY KEY(model, name)) STRICT, WITHOUT ROWID;
CREATE INDEX artefacts_by_hash ON artefacts(sha256);
CREATE TABLE jobs(
  number INTEGER PRIMARY KEY AUTOINCREMENT,
  id TEXT NOT NULL UNIQUE, model TEXT NOT NULL REFERENCES models(id) ON DELETE CASCADE,
  kind INTEGER NOT NULL, state INTEGER NOT NULL, progress REAL NOT NULL, stage TEXT NOT NULL,
  created TEXT NOT NULL, updated TEXT NOT NULL, problem TEXT NOT NULL,
  metric TEXT NOT NULL, weights TEXT NOT NULL, weight_bits INTEGER NOT NULL, attempts INTEGER NOT NULL) STRICT;
CREATE INDEX jobs_by_model ON jobs(model, kind);
CREATE TABLE streams(
  number INTEGER PRIMARY KEY AUTOINCREMENT,
  id TEXT NOT NULL UNIQUE, title TEXT NOT NULL, model TEXT NOT NULL, created TEXT NOT NULL) STRICT;
CREATE TABLE idempotency(
  key TEXT PRIMARY KEY, fingerprint TEXT NOT NULL, resource TEXT NOT NULL, created TEXT NOT NULL) STRICT;
)sql";

/// Jobs may have no model; job_files are the files that a job needs besides those of its model.
constexpr const char* with_displacement_sets = R"sql(
CREATE TABLE new_jobs(
  number INTEGER PRIMARY KEY AUTOINCREMENT,
  id TEXT NOT NULL UNIQUE, model TEXT REFERENCES models(id) ON DELETE CASCADE,
  kind INTEGER NOT NULL, state INTEGER NOT NULL, progress REAL NOT NULL, stage TEXT NOT NULL,
  created TEXT NOT NULL, updated TEXT NOT NULL, problem TEXT NOT NULL,
  metric TEXT NOT NULL, weights TEXT NOT NULL, weight_bits INTEGER NOT NULL, attempts INTEGER NOT NULL,
  result TEXT NOT NULL, lods TEXT NOT NULL, extraction TEXT NOT NULL) STRICT;
INSERT INTO new_jobs SELECT number, id, model, kind, state, progress, stage, created, updated, problem, metric, weights,
  weight_bits, attempts, result, lods, '' FROM jobs;
DROP TABLE jobs;
ALTER TABLE new_jobs RENAME TO jobs;
CREATE INDEX jobs_by_model ON jobs(model, kind);
CREATE TABLE job_files(
  job TEXT NOT NULL REFERENCES jobs(id) ON DELETE CASCADE, sha256 TEXT NOT NULL,
  PRIMARY KEY(job, sha256)) STRICT, WITHOUT ROWID;
CREATE INDEX job_files_by_hash ON job_files(sha256);
CREATE TABLE displacement_sets(
  number INTEGER PRIMARY KEY AUTOINCREMENT,
  id TEXT NOT NULL UNIQUE, name TEXT NOT NULL, kind TEXT NOT NULL, revision INTEGER NOT NULL,
  created TEXT NOT NULL, updated TEXT NOT NULL, displacements TEXT NOT NULL, source TEXT NOT NULL) STRICT;
CREATE TABLE worn_sets(
  model TEXT NOT NULL REFERENCES models(id) ON DELETE CASCADE, slot TEXT NOT NULL,
  displacement_set TEXT NOT NULL, name TEXT NOT NULL, revision INTEGER NOT NULL, displacements TEXT NOT NULL,
  PRIMARY KEY(model, slot)) STRICT, WITHOUT ROWID;
)sql";

constexpr const char* with_recordings = R"sql(
CREATE TABLE recordings(
  number INTEGER PRIMARY KEY AUTOINCREMENT,
  id TEXT NOT NULL UNIQUE, stream TEXT NOT NULL, name TEXT NOT NULL, model TEXT NOT NULL, created TEXT NOT NULL,
  state INTEGER NOT NULL, ended TEXT NOT NULL, duration INTEGER NOT NULL, frames INTEGER NOT NULL,
  lost INTEGER NOT NULL, bytes INTEGER NOT NULL, epoch INTEGER NOT NULL, media_time INTEGER NOT NULL,
  max_duration INTEGER) STRICT;
CREATE INDEX recordings_by_stream ON recordings(stream);
)sql";

/// One row. A database of an earlier version has had at least one start.
constexpr const char* with_identity = R"sql(
CREATE TABLE identity(id TEXT NOT NULL, starts INTEGER NOT NULL) STRICT;
INSERT INTO identity SELECT lower(hex(randomblob(16))), EXISTS(SELECT 1 FROM sqlite_sequence WHERE seq > 0);
)sql";

/// The request of a job is one JSON text, whose form depends on the kind; a kind is a name instead of a number. The
/// columns are changed in place, because dropping the table would delete the rows of job_files too.
constexpr const char* with_job_requests = R"sql(
ALTER TABLE jobs ADD COLUMN request TEXT NOT NULL DEFAULT '{}';
UPDATE jobs SET request = json_object('metric', metric, 'weights', weights, 'weight_bits', weight_bits,
  'lods', json(CASE WHEN json_valid(lods) THEN lods ELSE '[]' END)) WHERE kind = 1;
UPDATE jobs SET request = extraction WHERE kind = 3 AND extraction <> '';
ALTER TABLE jobs DROP COLUMN metric;
ALTER TABLE jobs DROP COLUMN weights;
ALTER TABLE jobs DROP COLUMN weight_bits;
ALTER TABLE jobs DROP COLUMN lods;
ALTER TABLE jobs DROP COLUMN extraction;
ALTER TABLE jobs ADD COLUMN kind_name TEXT NOT NULL DEFAULT '';
UPDATE jobs SET kind_name = CASE kind WHEN 0 THEN 'import' WHEN 1 THEN 'parametrize' WHEN 2 THEN 'propose'
  ELSE 'extract' END;
DROP INDEX jobs_by_model;
ALTER TABLE jobs DROP COLUMN kind;
ALTER TABLE jobs RENAME COLUMN kind_name TO kind;
CREATE INDEX jobs_by_model ON jobs(model, kind);
)sql";

constexpr const char* with_tokens = R"sql(
CREATE TABLE tokens(
  number INTEGER PRIMARY KEY AUTOINCREMENT,
  id TEXT NOT NULL UNIQUE, name TEXT NOT NULL, scope TEXT NOT NULL, stream TEXT NOT NULL, model TEXT NOT NULL,
  created TEXT NOT NULL, expires INTEGER, secret_hash TEXT NOT NULL) STRICT;
ALTER TABLE streams ADD COLUMN is_public INTEGER NOT NULL DEFAULT 0;
)sql";

/// Whose request made a record: the id of a token. Records of earlier versions have no owner.
constexpr const char* with_owners = R"sql(
ALTER TABLE models ADD COLUMN owner TEXT NOT NULL DEFAULT '';
ALTER TABLE displacement_sets ADD COLUMN owner TEXT NOT NULL DEFAULT '';
ALTER TABLE streams ADD COLUMN owner TEXT NOT NULL DEFAULT '';
ALTER TABLE recordings ADD COLUMN owner TEXT NOT NULL DEFAULT '';
ALTER TABLE jobs ADD COLUMN owner TEXT NOT NULL DEFAULT '';
ALTER TABLE jobs ADD COLUMN request_id TEXT NOT NULL DEFAULT '';
CREATE INDEX models_by_owner ON models(owner);
CREATE INDEX displacement_sets_by_owner ON displacement_sets(owner);
CREATE INDEX streams_by_owner ON streams(owner);
CREATE INDEX recordings_by_owner ON recordings(owner);
CREATE INDEX unfinished_jobs_by_owner ON jobs(owner) WHERE state IN (0, 1);
)sql";

/// Files of a speech are blobs, like artefacts.
constexpr const char* with_speeches = R"sql(
CREATE TABLE speeches(
  number INTEGER PRIMARY KEY AUTOINCREMENT,
  id TEXT NOT NULL UNIQUE, created TEXT NOT NULL, request TEXT NOT NULL, text TEXT NOT NULL, voice TEXT NOT NULL,
  duration INTEGER NOT NULL, warnings TEXT NOT NULL, owner TEXT NOT NULL) STRICT;
CREATE INDEX speeches_by_owner ON speeches(owner);
CREATE TABLE speech_files(
  speech TEXT NOT NULL REFERENCES speeches(id) ON DELETE CASCADE, name TEXT NOT NULL, sha256 TEXT NOT NULL,
  bytes INTEGER NOT NULL, content_type TEXT NOT NULL, PRIMARY KEY(speech, name)) STRICT, WITHOUT ROWID;
CREATE INDEX speech_files_by_hash ON speech_files(sha256);
)sql";

/// Step n migrates a file from version n to n + 1; an empty file has version 0. Released steps never change.
constexpr std::array migrations = {
    first_schema,
    "ALTER TABLE feature_points ADD COLUMN proposal TEXT; ALTER TABLE jobs ADD COLUMN result TEXT NOT NULL DEFAULT ''",
    "ALTER TABLE packages ADD COLUMN levels TEXT NOT NULL DEFAULT '[]';"
    "ALTER TABLE jobs ADD COLUMN lods TEXT NOT NULL DEFAULT ''",
    with_displacement_sets,
    "ALTER TABLE streams ADD COLUMN viseme_share REAL",
    "ALTER TABLE streams ADD COLUMN batch_interval INTEGER NOT NULL DEFAULT 100",
    with_recordings,
    "ALTER TABLE streams ADD COLUMN quantizer_scale REAL NOT NULL DEFAULT 1",
    with_identity,
    with_job_requests,
    with_tokens,
    with_owners,
    with_speeches,
    "ALTER TABLE recordings ADD COLUMN sound_packets INTEGER",
};
constexpr int schema_version = migrations.size();

/// Whether it has no table, or is of this program, which has had a table of models from the first version on.
bool is_ours(Database& db, int version) {
  Statement tables(db, "SELECT count(*), coalesce(sum(name = 'models'), 0) FROM sqlite_master WHERE type = 'table'");
  return tables.step() && (version == 0 ? tables.integer(0) == 0 : tables.integer(1) == 1);
}

Status check_version(Database& db, int version) {
  if (version < 0 || !is_ours(db, version))
    return Error{ErrorCode::malformed, "", "it is the database of another program"};
  if (version > schema_version)
    return Error{ErrorCode::unsupported, "", "the data folder was written by a later version of this program"};
  return Unit{};
}

}  // namespace

int current_schema_version() { return schema_version; }

int schema_version_of(Database& db) {
  Statement statement(db, "PRAGMA user_version");
  return statement.step() ? static_cast<int>(statement.integer(0)) : 0;
}

Status check_schema(Database& db) { return check_version(db, schema_version_of(db)); }

Status bring_up_to_date(Database& db) {
  if (const int found = schema_version_of(db); found > 0) {
    auto checked = check_version(db, found);
    if (!checked || found == schema_version) return checked;
  }
  Transaction transaction(db);
  // Read again: another process may have made the tables before the transaction began.
  const int version = schema_version_of(db);
  if (auto checked = check_version(db, version); !checked) return checked;
  for (int step = version; step < schema_version; ++step) db.execute(migrations[static_cast<std::size_t>(step)]);
  set_schema_version(db);
  transaction.commit();
  return Unit{};
}

void set_schema_version(Database& db) { db.execute(("PRAGMA user_version=" + std::to_string(schema_version)).c_str()); }

}  // namespace semblante::store
