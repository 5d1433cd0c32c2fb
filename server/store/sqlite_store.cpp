#include "server/store/sqlite_store.h"

#include <array>
#include <mutex>

#include "server/store/facts_json.h"
#include "server/store/sqlite.h"

namespace semblante::store {
namespace {

/// Lists that are only ever read whole (parts, warnings, boxes) are one JSON column; what is looked up has its own.
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

/// Step n takes a file of version n to version n + 1; an empty file has version 0. Steps that were released never
/// change.
constexpr std::array migrations = {
    first_schema,
    "ALTER TABLE feature_points ADD COLUMN proposal TEXT; ALTER TABLE jobs ADD COLUMN result TEXT NOT NULL DEFAULT ''",
    "ALTER TABLE packages ADD COLUMN levels TEXT NOT NULL DEFAULT '[]';"
    "ALTER TABLE jobs ADD COLUMN lods TEXT NOT NULL DEFAULT ''",
};
constexpr int schema_version = migrations.size();

constexpr const char* model_columns =
    "SELECT m.id, m.name, m.state, m.problem, m.created, m.updated, m.revision, m.file_name, m.format, "
    "m.source_bytes, m.source_sha256, m.vertices, m.triangles, m.facts, m.points_revision, "
    "(SELECT count(*) FROM feature_points f WHERE f.model = m.id), "
    "p.parametrization, p.created, p.metric, p.weights, p.weight_bits, p.levels "
    "FROM models m LEFT JOIN packages p ON p.model = m.id ";

ModelRecord read_model(const Statement& row) {
  ModelRecord model;
  model.id = row.text(0);
  model.name = row.text(1);
  model.state = static_cast<ModelState>(row.integer(2));
  model.problem = row.text(3);
  model.created = row.text(4);
  model.updated = row.text(5);
  model.revision = static_cast<std::uint64_t>(row.integer(6));
  model.file_name = row.text(7);
  model.format = row.text(8);
  model.source_bytes = static_cast<std::uint64_t>(row.integer(9));
  model.source_sha256 = row.text(10);
  model.vertices = static_cast<std::uint32_t>(row.integer(11));
  model.triangles = static_cast<std::uint32_t>(row.integer(12));
  read_facts(row.text(13), model);
  model.feature_points_revision = static_cast<std::uint64_t>(row.integer(14));
  model.feature_point_count = static_cast<std::uint32_t>(row.integer(15));
  if (!row.is_null(16))
    model.package = PackageRecord{row.text(16),
                                  row.text(17),
                                  row.text(18),
                                  row.text(19),
                                  static_cast<int>(row.integer(20)),
                                  read_levels(row.text(21))};
  return model;
}

constexpr const char* job_columns =
    "SELECT id, model, kind, state, progress, stage, created, updated, problem, metric, weights, weight_bits, "
    "attempts, "
    "result, lods FROM jobs ";

JobRecord read_job(const Statement& row) {
  JobRecord job;
  job.id = row.text(0);
  job.model = row.text(1);
  job.kind = static_cast<JobKind>(row.integer(2));
  job.state = static_cast<JobState>(row.integer(3));
  job.progress = row.real(4);
  job.stage = row.text(5);
  job.created = row.text(6);
  job.updated = row.text(7);
  job.problem = row.text(8);
  job.metric = row.text(9);
  job.weights = row.text(10);
  job.weight_bits = static_cast<int>(row.integer(11));
  job.attempts = static_cast<std::uint32_t>(row.integer(12));
  job.result = row.text(13);
  job.lods = read_lods(row.text(14));
  return job;
}

ArtefactRecord read_artefact(const Statement& row) {
  return {row.text(0), row.text(1), static_cast<std::uint64_t>(row.integer(2)), row.text(3)};
}

/// Owns the connection; `mutex_` guards it, every public call takes it once.
class SqliteStore : public Store {
 public:
  explicit SqliteStore(const std::string& file) : db_(file) {
    db_.execute("PRAGMA journal_mode=WAL");
    db_.execute("PRAGMA synchronous=FULL");
    db_.execute("PRAGMA foreign_keys=ON");
  }

  Status prepare() {
    int version = 0;
    {
      Statement statement(db_, "PRAGMA user_version");
      if (statement.step()) version = static_cast<int>(statement.integer(0));
    }
    if (version > schema_version)
      return Error{ErrorCode::unsupported, "", "the data folder was written by a later version of this program"};
    if (version == schema_version) return Unit{};
    Transaction transaction(db_);
    for (int step = version; step < schema_version; ++step) db_.execute(migrations[static_cast<std::size_t>(step)]);
    db_.execute(("PRAGMA user_version=" + std::to_string(schema_version)).c_str());
    transaction.commit();
    return Unit{};
  }

  bool create_model(const ModelRecord& model, const ArtefactRecord& source, const JobRecord& job,
                    const std::optional<IdempotencyRecord>& key) override {
    const std::lock_guard lock(mutex_);
    Transaction transaction(db_);
    Statement(db_, "INSERT OR IGNORE INTO models VALUES(NULL,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?)")
        .bind(model.id, model.name, static_cast<int>(model.state), model.problem, model.created, model.updated,
              model.revision, model.file_name, model.format, model.source_bytes, model.source_sha256, model.vertices,
              model.triangles, write_facts(model), model.feature_points_revision)
        .run();
    if (db_.changes() == 0) return false;
    insert_artefact(model.id, source, false);
    insert_job(job);
    insert_key(key);
    transaction.commit();
    return true;
  }

  std::optional<ModelRecord> model(std::string_view id) override {
    const std::lock_guard lock(mutex_);
    Statement statement(db_, std::string(model_columns) + "WHERE m.id = ?");
    statement.bind(id);
    if (!statement.step()) return std::nullopt;
    return read_model(statement);
  }

  std::optional<std::vector<ModelRecord>> models(std::string_view after, std::size_t limit) override {
    const std::lock_guard lock(mutex_);
    std::int64_t number = 0;
    if (!after.empty()) {
      Statement statement(db_, "SELECT number FROM models WHERE id = ?");
      statement.bind(after);
      if (!statement.step()) return std::nullopt;
      number = statement.integer(0);
    }
    std::vector<ModelRecord> list;
    Statement statement(db_, std::string(model_columns) + "WHERE m.number > ? ORDER BY m.number LIMIT ?");
    statement.bind(number, static_cast<std::uint64_t>(limit));
    while (statement.step()) list.push_back(read_model(statement));
    return list;
  }

  std::size_t model_count() override {
    const std::lock_guard lock(mutex_);
    Statement statement(db_, "SELECT count(*) FROM models");
    statement.step();
    return static_cast<std::size_t>(statement.integer(0));
  }

  bool edit_model(std::string_view id, const std::optional<std::string>& name, const std::vector<RoleChange>& roles,
                  std::uint64_t expected_revision) override {
    const std::lock_guard lock(mutex_);
    Transaction transaction(db_);
    auto model = locked_model(id);
    if (!model || model->revision != expected_revision) return false;
    for (const auto& [part, role] : roles) {
      if (part >= model->parts.size()) return false;
      auto& record = model->parts[part];
      record.role_by_user = role.has_value();
      if (role) record.role = *role;
    }
    Statement(db_, "UPDATE models SET name = ?, facts = ?, revision = revision + 1, updated = ? WHERE id = ?")
        .bind(name.value_or(model->name), write_facts(*model), timestamp_now(), id)
        .run();
    transaction.commit();
    return true;
  }

  bool edit_frame(std::string_view id, const FrameWish& wish, const ModelFrame& frame,
                  const std::optional<JobRecord>& import, std::uint64_t expected_revision) override {
    const std::lock_guard lock(mutex_);
    Transaction transaction(db_);
    auto model = locked_model(id);
    if (!model || model->revision != expected_revision) return false;
    model->frame_wish = wish;
    model->frame = frame;
    if (import) {
      model->state = ModelState::importing;
      insert_job(*import);
    }
    Statement(db_, "UPDATE models SET state = ?, facts = ?, revision = revision + 1, updated = ? WHERE id = ?")
        .bind(static_cast<int>(model->state), write_facts(*model), timestamp_now(), id)
        .run();
    transaction.commit();
    return true;
  }

  std::optional<std::vector<std::string>> remove_model(std::string_view id) override {
    const std::lock_guard lock(mutex_);
    Transaction transaction(db_);
    const auto hashes = hashes_of(id);
    Statement(db_, "DELETE FROM models WHERE id = ?").bind(id).run();
    if (db_.changes() == 0) return std::nullopt;
    auto orphans = without_reference(hashes);
    transaction.commit();
    return orphans;
  }

  std::vector<FeaturePointRecord> feature_points(std::string_view model) override {
    const std::lock_guard lock(mutex_);
    return locked_points(model);
  }

  bool put_feature_points(std::string_view model, const std::vector<FeaturePointRecord>& points,
                          std::uint64_t expected_revision) override {
    const std::lock_guard lock(mutex_);
    Transaction transaction(db_);
    Statement(db_,
              "UPDATE models SET points_revision = points_revision + 1, revision = revision + 1, updated = ? "
              "WHERE id = ? AND points_revision = ?")
        .bind(timestamp_now(), model, expected_revision)
        .run();
    if (db_.changes() == 0) return false;
    write_points(model, points);
    transaction.commit();
    return true;
  }

  std::optional<ArtefactRecord> artefact(std::string_view model, std::string_view name) override {
    const std::lock_guard lock(mutex_);
    Statement statement(db_, "SELECT name, sha256, bytes, content_type FROM artefacts WHERE model = ? AND name = ?");
    statement.bind(model, name);
    if (!statement.step()) return std::nullopt;
    return read_artefact(statement);
  }

  std::vector<ArtefactRecord> artefacts(std::string_view model) override {
    const std::lock_guard lock(mutex_);
    std::vector<ArtefactRecord> list;
    Statement statement(db_, "SELECT name, sha256, bytes, content_type FROM artefacts WHERE model = ? ORDER BY name");
    statement.bind(model);
    while (statement.step()) list.push_back(read_artefact(statement));
    return list;
  }

  std::optional<ArtefactRecord> public_artefact(std::string_view sha256) override {
    const std::lock_guard lock(mutex_);
    Statement statement(db_,
                        "SELECT name, sha256, bytes, content_type FROM artefacts WHERE sha256 = ? "
                        "AND name NOT IN ('source', 'positions') LIMIT 1");
    statement.bind(sha256);
    if (!statement.step()) return std::nullopt;
    return read_artefact(statement);
  }

  std::vector<std::string> referenced_hashes() override {
    const std::lock_guard lock(mutex_);
    std::vector<std::string> hashes;
    Statement statement(db_, "SELECT DISTINCT sha256 FROM artefacts");
    while (statement.step()) hashes.push_back(statement.text(0));
    return hashes;
  }

  void create_job(const JobRecord& job, const std::optional<IdempotencyRecord>& key) override {
    const std::lock_guard lock(mutex_);
    Transaction transaction(db_);
    insert_job(job);
    insert_key(key);
    transaction.commit();
  }

  std::optional<JobRecord> job(std::string_view id) override {
    const std::lock_guard lock(mutex_);
    Statement statement(db_, std::string(job_columns) + "WHERE id = ?");
    statement.bind(id);
    if (!statement.step()) return std::nullopt;
    return read_job(statement);
  }

  std::vector<JobRecord> unfinished_jobs() override {
    const std::lock_guard lock(mutex_);
    std::vector<JobRecord> list;
    Statement statement(db_, std::string(job_columns) + "WHERE state IN (0, 1) ORDER BY number");
    while (statement.step()) list.push_back(read_job(statement));
    return list;
  }

  std::optional<JobRecord> latest_job(std::string_view model, JobKind kind) override {
    const std::lock_guard lock(mutex_);
    Statement statement(db_, std::string(job_columns) + "WHERE model = ? AND kind = ? ORDER BY number DESC LIMIT 1");
    statement.bind(model, static_cast<int>(kind));
    if (!statement.step()) return std::nullopt;
    return read_job(statement);
  }

  void update_job(const JobRecord& job) override {
    const std::lock_guard lock(mutex_);
    write_job(job);
  }

  std::optional<std::vector<std::string>> finish_import(const JobRecord& job, const ModelRecord& facts,
                                                        const std::vector<ArtefactRecord>& artefacts,
                                                        const std::optional<Turn>& turn) override {
    const std::lock_guard lock(mutex_);
    Transaction transaction(db_);
    const auto before = locked_model(job.model);
    if (!before) return std::nullopt;
    ModelRecord now = facts;
    now.frame_wish = before->frame_wish;
    for (std::size_t i = 0; i < now.parts.size() && now.parts.size() == before->parts.size(); ++i) {
      if (!before->parts[i].role_by_user) continue;
      now.parts[i].role = before->parts[i].role;
      now.parts[i].role_by_user = true;
    }
    Statement(db_,
              "UPDATE models SET state = ?, problem = '', format = ?, vertices = ?, triangles = ?, facts = ?, "
              "revision = revision + 1, updated = ? WHERE id = ?")
        .bind(static_cast<int>(ModelState::ready), now.format, now.vertices, now.triangles, write_facts(now),
              timestamp_now(), job.model)
        .run();
    const auto old_hashes = hashes_of(job.model);
    Statement(db_, "DELETE FROM artefacts WHERE model = ? AND name <> 'source'").bind(job.model).run();
    Statement(db_, "DELETE FROM packages WHERE model = ?").bind(job.model).run();
    for (const auto& artefact : artefacts) insert_artefact(job.model, artefact, false);
    if (turn) turn_points(job.model, *turn);
    write_job(job);
    auto orphans = without_reference(old_hashes);
    transaction.commit();
    return orphans;
  }

  std::optional<std::vector<std::string>> finish_parametrization(const JobRecord& job, const PackageRecord& package,
                                                                 const std::vector<PartRecord>& parts,
                                                                 const std::vector<std::string>& warnings,
                                                                 const std::optional<FindingCounts>& findings,
                                                                 const std::vector<ArtefactRecord>& artefacts,
                                                                 const FrameUpdate& frame) override {
    const std::lock_guard lock(mutex_);
    Transaction transaction(db_);
    auto model = locked_model(job.model);
    if (!model) return std::nullopt;
    const auto old_hashes = hashes_of(job.model);
    Statement(db_, "DELETE FROM artefacts WHERE model = ? AND of_package = 1").bind(job.model).run();
    // A model that was turned has a new preview and new positions, which outlive the package.
    for (const auto& artefact : artefacts)
      insert_artefact(job.model, artefact, artefact.name != "preview.glb" && artefact.name != "positions");
    Statement(db_, "INSERT OR REPLACE INTO packages VALUES(?,?,?,?,?,?,?)")
        .bind(job.model, package.parametrization, package.created, package.metric, package.weights, package.weight_bits,
              write_levels(package.levels))
        .run();
    // A role that a user set while the job ran stays the user's.
    for (std::size_t i = 0; i < parts.size() && i < model->parts.size(); ++i)
      if (!model->parts[i].role_by_user) model->parts[i].role = parts[i].role;
    model->warnings = warnings;
    model->findings = findings;
    if (frame.frame) model->frame = frame.frame;
    if (frame.turn) {
      model->box_min = frame.box_min;
      model->box_max = frame.box_max;
      for (std::size_t i = 0; i < parts.size() && i < model->parts.size(); ++i) {
        model->parts[i].box_min = parts[i].box_min;
        model->parts[i].box_max = parts[i].box_max;
      }
      turn_points(job.model, *frame.turn);
    }
    Statement(db_,
              "UPDATE models SET state = ?, problem = '', facts = ?, revision = revision + 1, updated = ? WHERE id = ?")
        .bind(static_cast<int>(ModelState::parametrized), write_facts(*model), timestamp_now(), job.model)
        .run();
    write_job(job);
    auto orphans = without_reference(old_hashes);
    transaction.commit();
    return orphans;
  }

  bool finish_proposal(const JobRecord& job, const std::vector<FeaturePointRecord>& proposals) override {
    const std::lock_guard lock(mutex_);
    Transaction transaction(db_);
    Statement(db_,
              "UPDATE models SET points_revision = points_revision + 1, revision = revision + 1, updated = ? "
              "WHERE id = ?")
        .bind(timestamp_now(), job.model)
        .run();
    if (db_.changes() == 0) return false;
    write_points(job.model, with_proposals(locked_points(job.model), proposals));
    write_job(job);
    transaction.commit();
    return true;
  }

  void finish_without_result(const JobRecord& job) override {
    const std::lock_guard lock(mutex_);
    Transaction transaction(db_);
    write_job(job);
    if (job.kind == JobKind::import)
      Statement(db_, "UPDATE models SET state = ?, problem = ?, revision = revision + 1, updated = ? WHERE id = ?")
          .bind(static_cast<int>(ModelState::failed), job.problem, timestamp_now(), job.model)
          .run();
    transaction.commit();
  }

  bool create_stream(const StreamRecord& stream, const std::optional<IdempotencyRecord>& key) override {
    const std::lock_guard lock(mutex_);
    Transaction transaction(db_);
    Statement(db_, "INSERT OR IGNORE INTO streams VALUES(NULL,?,?,?,?)")
        .bind(stream.id, stream.title, stream.model, stream.created)
        .run();
    if (db_.changes() == 0) return false;
    insert_key(key);
    transaction.commit();
    return true;
  }

  std::vector<StreamRecord> streams() override {
    const std::lock_guard lock(mutex_);
    std::vector<StreamRecord> list;
    Statement statement(db_, "SELECT id, title, model, created FROM streams ORDER BY number");
    while (statement.step())
      list.push_back({statement.text(0), statement.text(1), statement.text(2), statement.text(3)});
    return list;
  }

  bool remove_stream(std::string_view id) override {
    const std::lock_guard lock(mutex_);
    Statement(db_, "DELETE FROM streams WHERE id = ?").bind(id).run();
    return db_.changes() != 0;
  }

  std::optional<IdempotencyRecord> idempotency(std::string_view key) override {
    const std::lock_guard lock(mutex_);
    Statement statement(db_, "SELECT key, fingerprint, resource FROM idempotency WHERE key = ?");
    statement.bind(key);
    if (!statement.step()) return std::nullopt;
    return IdempotencyRecord{statement.text(0), statement.text(1), statement.text(2)};
  }

  bool healthy() override {
    const std::lock_guard lock(mutex_);
    Statement statement(db_, "SELECT count(*) FROM streams");
    return statement.step();
  }

 private:
  std::optional<ModelRecord> locked_model(std::string_view id) {
    Statement statement(db_, std::string(model_columns) + "WHERE m.id = ?");
    statement.bind(id);
    if (!statement.step()) return std::nullopt;
    return read_model(statement);
  }

  std::vector<FeaturePointRecord> locked_points(std::string_view model) {
    std::vector<FeaturePointRecord> points;
    Statement statement(db_,
                        "SELECT id, vertex, x, y, z, proposal FROM feature_points WHERE model = ? ORDER BY position");
    statement.bind(model);
    while (statement.step()) {
      FeaturePointRecord point;
      point.id = statement.text(0);
      if (!statement.is_null(1)) point.vertex = static_cast<std::uint32_t>(statement.integer(1));
      if (!statement.is_null(2)) point.position = {statement.real(2), statement.real(3), statement.real(4)};
      if (!statement.is_null(5)) point.proposal = read_proposal(statement.text(5));
      points.push_back(std::move(point));
    }
    return points;
  }

  void write_points(std::string_view model, const std::vector<FeaturePointRecord>& points) {
    Statement(db_, "DELETE FROM feature_points WHERE model = ?").bind(model).run();
    int position = 0;
    for (const auto& point : points) {
      std::optional<double> x, y, z;
      if (point.position) {
        x = (*point.position)[0];
        y = (*point.position)[1];
        z = (*point.position)[2];
      }
      std::optional<std::string> proposal;
      if (point.proposal) proposal = write_proposal(*point.proposal);
      Statement(db_,
                "INSERT INTO feature_points(model, position, id, vertex, x, y, z, proposal) VALUES(?,?,?,?,?,?,?,?)")
          .bind(model, position++, point.id, point.vertex, x, y, z, proposal)
          .run();
    }
  }

  /// Marked positions go where the model goes.
  void turn_points(std::string_view model, const Turn& r) {
    Statement(db_,
              "UPDATE feature_points SET x = ?*x + ?*y + ?*z, y = ?*x + ?*y + ?*z, z = ?*x + ?*y + ?*z "
              "WHERE model = ? AND x IS NOT NULL")
        .bind(r[0], r[1], r[2], r[3], r[4], r[5], r[6], r[7], r[8], model)
        .run();
    Statement(db_, "UPDATE models SET points_revision = points_revision + 1 WHERE id = ? AND points_revision > 0")
        .bind(model)
        .run();
  }

  void insert_artefact(std::string_view model, const ArtefactRecord& artefact, bool of_package) {
    Statement(db_, "INSERT OR REPLACE INTO artefacts VALUES(?,?,?,?,?,?)")
        .bind(model, artefact.name, artefact.sha256, artefact.bytes, artefact.content_type, of_package ? 1 : 0)
        .run();
  }

  void insert_job(const JobRecord& job) {
    Statement(db_, "INSERT INTO jobs VALUES(NULL,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?)")
        .bind(job.id, job.model, static_cast<int>(job.kind), static_cast<int>(job.state), job.progress, job.stage,
              job.created, job.updated, job.problem, job.metric, job.weights, job.weight_bits, job.attempts, job.result,
              write_lods(job.lods))
        .run();
  }

  void write_job(const JobRecord& job) {
    Statement(db_,
              "UPDATE jobs SET state = ?, progress = ?, stage = ?, updated = ?, problem = ?, attempts = ?, result = ? "
              "WHERE id = ?")
        .bind(static_cast<int>(job.state), job.progress, job.stage, job.updated, job.problem, job.attempts, job.result,
              job.id)
        .run();
  }

  void insert_key(const std::optional<IdempotencyRecord>& key) {
    if (!key) return;
    // Keys are for retries: a day is long for one.
    db_.execute("DELETE FROM idempotency WHERE created < strftime('%Y-%m-%dT%H:%M:%fZ', 'now', '-1 day')");
    Statement(db_, "INSERT INTO idempotency VALUES(?,?,?,?)")
        .bind(key->key, key->fingerprint, key->resource, timestamp_now())
        .run();
  }

  std::vector<std::string> hashes_of(std::string_view model) {
    std::vector<std::string> hashes;
    Statement statement(db_, "SELECT DISTINCT sha256 FROM artefacts WHERE model = ?");
    statement.bind(model);
    while (statement.step()) hashes.push_back(statement.text(0));
    return hashes;
  }

  std::vector<std::string> without_reference(const std::vector<std::string>& hashes) {
    std::vector<std::string> orphans;
    for (const auto& hash : hashes) {
      Statement statement(db_, "SELECT 1 FROM artefacts WHERE sha256 = ? LIMIT 1");
      statement.bind(hash);
      if (!statement.step()) orphans.push_back(hash);
    }
    return orphans;
  }

  std::mutex mutex_;
  Database db_;
};

}  // namespace

Result<std::unique_ptr<Store>> open_sqlite_store(const std::filesystem::path& file) {
  try {
    auto store = std::make_unique<SqliteStore>(file.string());
    if (auto prepared = store->prepare(); !prepared) return prepared.error();
    return Result<std::unique_ptr<Store>>(std::move(store));
  } catch (const std::exception& fault) {
    return Error{ErrorCode::io, file.string(), fault.what()};
  }
}

}  // namespace semblante::store
