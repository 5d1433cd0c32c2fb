#include "server/store/sqlite_store.h"

#include <mutex>

#include "server/store/facts_json.h"
#include "server/store/sqlite.h"
#include "server/store/sqlite_artefacts.h"
#include "server/store/sqlite_jobs.h"
#include "server/store/sqlite_models.h"
#include "server/store/sqlite_recordings.h"
#include "server/store/sqlite_schema.h"
#include "server/store/sqlite_sets.h"
#include "server/store/sqlite_streams.h"

namespace semblante::store {
namespace {

/// `exclusive` holds the index of the write-ahead log in memory instead of a file, which a full disk has no room for;
/// other programs cannot look into the database meanwhile.
enum class Locking { shared, exclusive };

/// Owns the connection; `mutex_` guards it, every public call takes it once.
class SqliteStore : public Store {
 public:
  SqliteStore(const std::string& file, Locking locking) : db_(file) {
    if (locking == Locking::exclusive) db_.execute("PRAGMA locking_mode=EXCLUSIVE");
    db_.execute("PRAGMA journal_mode=WAL");
    // An orderly end leaves the file of the write-ahead log, empty, so that a start on a full disk needs no new one.
    // The limit is what empties it: a log that is not empty would be applied to any database put in this one's place.
    int persist = 1;
    sqlite3_file_control(db_.get(), nullptr, SQLITE_FCNTL_PERSIST_WAL, &persist);
    db_.execute("PRAGMA journal_size_limit=16777216");
    db_.execute("PRAGMA temp_store=MEMORY");
    db_.execute("PRAGMA synchronous=FULL");
    db_.execute("PRAGMA foreign_keys=ON");
  }

  Status prepare() { return bring_up_to_date(db_); }

  bool create_model(const ModelRecord& model, const ArtefactRecord& source, const JobRecord& job,
                    const std::optional<IdempotencyRecord>& key) override {
    const std::lock_guard lock(mutex_);
    Transaction transaction(db_);
    if (!insert_model(db_, model)) return false;
    insert_artefact(db_, model.id, source, false);
    insert_job(db_, job);
    insert_key(key);
    transaction.commit();
    return true;
  }

  std::optional<ModelRecord> model(std::string_view id) override {
    const std::lock_guard lock(mutex_);
    return find_model(db_, id);
  }

  std::optional<std::vector<ModelRecord>> models(std::string_view after, std::size_t limit) override {
    const std::lock_guard lock(mutex_);
    return list_models(db_, after, limit);
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
    auto model = find_model(db_, id);
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
    auto model = find_model(db_, id);
    if (!model || model->revision != expected_revision) return false;
    model->frame_wish = wish;
    model->frame = frame;
    if (import) {
      model->state = ModelState::importing;
      insert_job(db_, *import);
    }
    Statement(db_, "UPDATE models SET state = ?, facts = ?, revision = revision + 1, updated = ? WHERE id = ?")
        .bind(static_cast<int>(model->state), write_facts(*model), timestamp_now(), id)
        .run();
    transaction.commit();
    return true;
  }

  bool edit_worn(std::string_view id, const std::vector<WornSet>& changes,
                 const std::optional<JobRecord>& parametrization, std::uint64_t expected_revision) override {
    const std::lock_guard lock(mutex_);
    Transaction transaction(db_);
    Statement(db_, "UPDATE models SET revision = revision + 1, updated = ? WHERE id = ? AND revision = ?")
        .bind(timestamp_now(), id, expected_revision)
        .run();
    if (db_.changes() == 0) return false;
    for (const auto& worn : changes) write_worn(db_, id, worn);
    if (parametrization) insert_job(db_, *parametrization);
    transaction.commit();
    return true;
  }

  std::vector<WornSet> worn_sets(std::string_view model) override {
    const std::lock_guard lock(mutex_);
    return read_worn(db_, model);
  }

  std::optional<std::vector<std::string>> remove_model(std::string_view id) override {
    const std::lock_guard lock(mutex_);
    Transaction transaction(db_);
    const auto hashes = hashes_of(db_, id);
    Statement(db_, "DELETE FROM models WHERE id = ?").bind(id).run();
    if (db_.changes() == 0) return std::nullopt;
    auto orphans = without_reference(db_, hashes);
    transaction.commit();
    return orphans;
  }

  std::vector<FeaturePointRecord> feature_points(std::string_view model) override {
    const std::lock_guard lock(mutex_);
    return read_points(db_, model);
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
    write_points(db_, model, points);
    transaction.commit();
    return true;
  }

  std::optional<ArtefactRecord> artefact(std::string_view model, std::string_view name) override {
    const std::lock_guard lock(mutex_);
    return find_artefact(db_, model, name);
  }

  std::vector<ArtefactRecord> artefacts(std::string_view model) override {
    const std::lock_guard lock(mutex_);
    return list_artefacts(db_, model);
  }

  std::optional<ArtefactRecord> public_artefact(std::string_view sha256) override {
    const std::lock_guard lock(mutex_);
    return find_public_artefact(db_, sha256);
  }

  std::uint64_t artefact_bytes() override {
    const std::lock_guard lock(mutex_);
    Statement statement(
        db_, "SELECT coalesce(sum(bytes), 0) FROM (SELECT max(bytes) AS bytes FROM artefacts GROUP BY sha256)");
    return statement.step() ? static_cast<std::uint64_t>(statement.integer(0)) : 0;
  }

  std::vector<std::string> referenced_hashes() override {
    const std::lock_guard lock(mutex_);
    return all_hashes(db_);
  }

  std::vector<std::string> users_of(std::string_view sha256) override {
    const std::lock_guard lock(mutex_);
    return users_of_hash(db_, sha256);
  }

  void create_job(const JobRecord& job, const std::vector<std::string>& files,
                  const std::optional<IdempotencyRecord>& key) override {
    const std::lock_guard lock(mutex_);
    Transaction transaction(db_);
    insert_job(db_, job);
    insert_job_files(db_, job.id, files);
    insert_key(key);
    transaction.commit();
  }

  std::optional<JobRecord> job(std::string_view id) override {
    const std::lock_guard lock(mutex_);
    return find_job(db_, id);
  }

  std::vector<JobRecord> unfinished_jobs() override {
    const std::lock_guard lock(mutex_);
    return list_unfinished_jobs(db_);
  }

  std::optional<JobRecord> latest_job(std::string_view model, std::string_view kind) override {
    const std::lock_guard lock(mutex_);
    return find_latest_job(db_, model, kind);
  }

  void update_job(const JobRecord& job) override {
    const std::lock_guard lock(mutex_);
    write_job(db_, job);
  }

  std::optional<std::vector<std::string>> finish_import(const JobRecord& job, const ModelRecord& facts,
                                                        const std::vector<ArtefactRecord>& artefacts,
                                                        const std::optional<Turn>& turn) override {
    const std::lock_guard lock(mutex_);
    Transaction transaction(db_);
    const auto before = find_model(db_, job.model);
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
    const auto old_hashes = hashes_of(db_, job.model);
    Statement(db_, "DELETE FROM artefacts WHERE model = ? AND name <> 'source'").bind(job.model).run();
    Statement(db_, "DELETE FROM packages WHERE model = ?").bind(job.model).run();
    for (const auto& artefact : artefacts) insert_artefact(db_, job.model, artefact, false);
    if (turn) turn_points(db_, job.model, *turn);
    write_job(db_, job);
    auto orphans = without_reference(db_, old_hashes);
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
    auto model = find_model(db_, job.model);
    if (!model) return std::nullopt;
    const auto old_hashes = hashes_of(db_, job.model);
    Statement(db_, "DELETE FROM artefacts WHERE model = ? AND of_package = 1").bind(job.model).run();
    // A model that was turned has a new preview and new positions, which outlive the package.
    for (const auto& artefact : artefacts)
      insert_artefact(db_, job.model, artefact, artefact.name != "preview.glb" && artefact.name != "positions");
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
      turn_points(db_, job.model, *frame.turn);
    }
    Statement(db_,
              "UPDATE models SET state = ?, problem = '', facts = ?, revision = revision + 1, updated = ? WHERE id = ?")
        .bind(static_cast<int>(ModelState::parametrized), write_facts(*model), timestamp_now(), job.model)
        .run();
    write_job(db_, job);
    auto orphans = without_reference(db_, old_hashes);
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
    write_points(db_, job.model, with_proposals(read_points(db_, job.model), proposals));
    write_job(db_, job);
    transaction.commit();
    return true;
  }

  std::vector<std::string> finish_job(const JobRecord& job) override {
    const std::lock_guard lock(mutex_);
    Transaction transaction(db_);
    write_job(db_, job);
    auto orphans = delete_job_files(db_, job.id);
    transaction.commit();
    return orphans;
  }

  std::vector<std::string> finish_failed_import(const JobRecord& job) override {
    const std::lock_guard lock(mutex_);
    Transaction transaction(db_);
    write_job(db_, job);
    auto orphans = delete_job_files(db_, job.id);
    if (const auto model = find_model(db_, job.model)) {
      const bool is_first = model->vertices == 0;
      const ModelState before = model->package ? ModelState::parametrized : ModelState::ready;
      Statement(db_, "UPDATE models SET state = ?, problem = ?, revision = revision + 1, updated = ? WHERE id = ?")
          .bind(static_cast<int>(is_first ? ModelState::failed : before), is_first ? job.problem : std::string(),
                timestamp_now(), job.model)
          .run();
    }
    transaction.commit();
    return orphans;
  }

  std::vector<std::string> finish_extraction(const JobRecord& job, const SetRecord& set) override {
    const std::lock_guard lock(mutex_);
    Transaction transaction(db_);
    insert_set(db_, set);
    write_job(db_, job);
    auto orphans = delete_job_files(db_, job.id);
    transaction.commit();
    return orphans;
  }

  bool request_cancel(std::string_view job) override {
    const std::lock_guard lock(mutex_);
    return mark_cancelled(db_, job);
  }

  void create_set(const SetRecord& set, const std::optional<IdempotencyRecord>& key) override {
    const std::lock_guard lock(mutex_);
    Transaction transaction(db_);
    insert_set(db_, set);
    insert_key(key);
    transaction.commit();
  }

  std::optional<SetRecord> set(std::string_view id) override {
    const std::lock_guard lock(mutex_);
    return find_set(db_, id);
  }

  std::optional<std::vector<SetRecord>> sets(std::string_view after, std::size_t limit) override {
    const std::lock_guard lock(mutex_);
    return list_sets(db_, after, limit);
  }

  std::size_t set_count() override {
    const std::lock_guard lock(mutex_);
    Statement statement(db_, "SELECT count(*) FROM displacement_sets");
    statement.step();
    return static_cast<std::size_t>(statement.integer(0));
  }

  bool put_set(const SetRecord& set) override {
    const std::lock_guard lock(mutex_);
    Statement(db_,
              "UPDATE displacement_sets SET name = ?, kind = ?, displacements = ?, revision = revision + 1, "
              "updated = ? WHERE id = ? AND revision = ?")
        .bind(set.name, set.kind, set.displacements, timestamp_now(), set.id, set.revision)
        .run();
    return db_.changes() != 0;
  }

  bool remove_set(std::string_view id) override {
    const std::lock_guard lock(mutex_);
    Statement(db_, "DELETE FROM displacement_sets WHERE id = ?").bind(id).run();
    return db_.changes() != 0;
  }

  bool create_stream(const StreamRecord& stream, const std::optional<IdempotencyRecord>& key) override {
    const std::lock_guard lock(mutex_);
    Transaction transaction(db_);
    if (!insert_stream(db_, stream)) return false;
    insert_key(key);
    transaction.commit();
    return true;
  }

  std::vector<StreamRecord> streams() override {
    const std::lock_guard lock(mutex_);
    return list_streams(db_);
  }

  bool remove_stream(std::string_view id) override {
    const std::lock_guard lock(mutex_);
    Statement(db_, "DELETE FROM streams WHERE id = ?").bind(id).run();
    return db_.changes() != 0;
  }

  void create_recording(const RecordingRecord& recording, const std::optional<IdempotencyRecord>& key) override {
    const std::lock_guard lock(mutex_);
    Transaction transaction(db_);
    insert_recording(db_, recording);
    insert_key(key);
    transaction.commit();
  }

  std::optional<RecordingRecord> recording(std::string_view id) override {
    const std::lock_guard lock(mutex_);
    return find_recording(db_, id);
  }

  std::optional<RecordingRecord> newest_recording(std::string_view stream) override {
    const std::lock_guard lock(mutex_);
    return find_newest_recording(db_, stream);
  }

  std::optional<std::vector<RecordingRecord>> recordings(std::string_view stream, std::string_view after,
                                                         std::size_t limit) override {
    const std::lock_guard lock(mutex_);
    return list_recordings(db_, stream, after, limit);
  }

  std::size_t recording_count() override {
    const std::lock_guard lock(mutex_);
    Statement statement(db_, "SELECT count(*) FROM recordings");
    statement.step();
    return static_cast<std::size_t>(statement.integer(0));
  }

  void finish_recording(const RecordingRecord& recording) override {
    const std::lock_guard lock(mutex_);
    write_recording(db_, recording);
  }

  bool remove_recording(std::string_view id) override {
    const std::lock_guard lock(mutex_);
    Statement(db_, "DELETE FROM recordings WHERE id = ?").bind(id).run();
    return db_.changes() != 0;
  }

  std::optional<IdempotencyRecord> idempotency(std::string_view key) override {
    const std::lock_guard lock(mutex_);
    Statement statement(db_, "SELECT key, fingerprint, resource FROM idempotency WHERE key = ?");
    statement.bind(key);
    if (!statement.step()) return std::nullopt;
    return IdempotencyRecord{statement.text(0), statement.text(1), statement.text(2)};
  }

  DatabaseIdentity identity() override {
    const std::lock_guard lock(mutex_);
    return read_identity();
  }

  DatabaseIdentity count_start() override {
    const std::lock_guard lock(mutex_);
    db_.execute("UPDATE identity SET starts = starts + 1");
    return read_identity();
  }

  bool healthy() override {
    const std::lock_guard lock(mutex_);
    Statement statement(db_, "SELECT count(*) FROM streams");
    return statement.step();
  }

  void check_writable() override {
    const std::lock_guard lock(mutex_);
    set_schema_version(db_);
  }

 private:
  DatabaseIdentity read_identity() {
    Statement statement(db_, "SELECT id, starts FROM identity");
    if (!statement.step()) return {};
    return {statement.text(0), static_cast<std::uint64_t>(statement.integer(1))};
  }

  void insert_key(const std::optional<IdempotencyRecord>& key) {
    if (!key) return;
    // Keys are for retries: a day is long for one.
    db_.execute("DELETE FROM idempotency WHERE created < strftime('%Y-%m-%dT%H:%M:%fZ', 'now', '-1 day')");
    Statement(db_, "INSERT INTO idempotency VALUES(?,?,?,?)")
        .bind(key->key, key->fingerprint, key->resource, timestamp_now())
        .run();
  }

  std::mutex mutex_;
  Database db_;
};

}  // namespace

namespace {

Result<std::unique_ptr<Store>> open_with(const std::filesystem::path& file, Locking locking) {
  auto store = std::make_unique<SqliteStore>(file.string(), locking);
  if (auto prepared = store->prepare(); !prepared) return prepared.error();
  return Result<std::unique_ptr<Store>>(std::move(store));
}

}  // namespace

Result<std::unique_ptr<Store>> open_sqlite_store(const std::filesystem::path& file) {
  try {
    try {
      return open_with(file, Locking::shared);
    } catch (const StoreError&) {
      return open_with(file, Locking::exclusive);
    }
  } catch (const DiskFull&) {
    throw;
  } catch (const std::exception& fault) {
    return Error{ErrorCode::io, file.string(), fault.what()};
  }
}

}  // namespace semblante::store
