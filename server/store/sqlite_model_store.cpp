#include "server/store/sqlite_model_store.h"

#include <algorithm>
#include <mutex>

#include "server/store/facts_json.h"
#include "server/store/sqlite_artefacts.h"
#include "server/store/sqlite_jobs.h"
#include "server/store/sqlite_keys.h"
#include "server/store/sqlite_models.h"
#include "server/store/sqlite_sets.h"

namespace semblante::store {

bool SqliteModelStore::create_model(const ModelRecord& model, const ArtefactRecord& source, const JobRecord& job,
                                    const std::optional<IdempotencyRecord>& key) {
  const std::lock_guard lock(mutex_);
  Transaction transaction(db_);
  if (!insert_model(db_, model)) return false;
  insert_artefact(db_, model.id, source, false);
  insert_job(db_, job);
  insert_key(db_, key);
  transaction.commit();
  return true;
}

std::optional<ModelRecord> SqliteModelStore::model(std::string_view id) {
  const std::lock_guard lock(mutex_);
  return find_model(db_, id);
}

std::optional<std::vector<ModelRecord>> SqliteModelStore::models(std::string_view after, std::size_t limit) {
  const std::lock_guard lock(mutex_);
  return list_models(db_, after, limit);
}

std::size_t SqliteModelStore::model_count() {
  const std::lock_guard lock(mutex_);
  Statement statement(db_, "SELECT count(*) FROM models");
  statement.step();
  return static_cast<std::size_t>(statement.integer(0));
}

bool SqliteModelStore::edit_model(std::string_view id, const std::optional<std::string>& name,
                                  const std::vector<RoleChange>& roles, std::uint64_t expected_revision) {
  const std::lock_guard lock(mutex_);
  Transaction transaction(db_);
  auto model = find_model(db_, id);
  if (!model || model->revision != expected_revision) return false;
  for (const auto& [part, role] : roles) {
    const auto record = std::find_if(model->parts.begin(), model->parts.end(),
                                     [index = part](const auto& item) { return item.index == index; });
    if (record == model->parts.end()) return false;
    record->role_by_user = role.has_value();
    if (role) record->role = *role;
  }
  Statement(db_, "UPDATE models SET name = ?, facts = ?, revision = revision + 1, updated = ? WHERE id = ?")
      .bind(name.value_or(model->name), write_facts(*model), timestamp_now(), id)
      .run();
  transaction.commit();
  return true;
}

bool SqliteModelStore::edit_frame(std::string_view id, const FrameWish& wish, const ModelFrame& frame,
                                  const std::optional<JobRecord>& import, std::uint64_t expected_revision) {
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

bool SqliteModelStore::edit_worn(std::string_view id, const std::vector<WornSet>& changes,
                                 const std::optional<JobRecord>& parametrization, std::uint64_t expected_revision) {
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

std::vector<WornSet> SqliteModelStore::worn_sets(std::string_view model) {
  const std::lock_guard lock(mutex_);
  return read_worn(db_, model);
}

std::optional<std::vector<std::string>> SqliteModelStore::remove_model(std::string_view id) {
  const std::lock_guard lock(mutex_);
  Transaction transaction(db_);
  const auto hashes = hashes_of(db_, id);
  Statement(db_, "DELETE FROM models WHERE id = ?").bind(id).run();
  if (db_.changes() == 0) return std::nullopt;
  auto orphans = without_reference(db_, hashes);
  transaction.commit();
  return orphans;
}

std::vector<FeaturePointRecord> SqliteModelStore::feature_points(std::string_view model) {
  const std::lock_guard lock(mutex_);
  return read_points(db_, model);
}

bool SqliteModelStore::put_points_and_fapu(std::string_view model, const std::vector<FeaturePointRecord>& points,
                                           const std::optional<FapuByUser>& fapu, std::uint64_t expected_revision) {
  const std::lock_guard lock(mutex_);
  Transaction transaction(db_);
  Statement(db_,
            "UPDATE models SET points_revision = points_revision + 1, revision = revision + 1, updated = ? "
            "WHERE id = ? AND points_revision = ?")
      .bind(timestamp_now(), model, expected_revision)
      .run();
  if (db_.changes() == 0) return false;
  write_points(db_, model, points);
  if (fapu) {
    auto record = find_model(db_, model);
    record->fapu = *fapu;
    Statement(db_, "UPDATE models SET facts = ? WHERE id = ?").bind(write_facts(*record), model).run();
  }
  transaction.commit();
  return true;
}

}  // namespace semblante::store
