#include "server/store/sqlite_job_store.h"

#include <mutex>

#include "server/store/facts_json.h"
#include "server/store/sqlite_artefacts.h"
#include "server/store/sqlite_jobs.h"
#include "server/store/sqlite_keys.h"
#include "server/store/sqlite_models.h"
#include "server/store/sqlite_sets.h"

namespace semblante::store {

void SqliteJobStore::create_job(const JobRecord& job, const std::vector<std::string>& files,
                                const std::optional<IdempotencyRecord>& key) {
  const std::lock_guard lock(mutex_);
  Transaction transaction(db_);
  insert_job(db_, job);
  insert_job_files(db_, job.id, files);
  insert_key(db_, key);
  transaction.commit();
}

std::optional<JobRecord> SqliteJobStore::job(std::string_view id) {
  const std::lock_guard lock(mutex_);
  return find_job(db_, id);
}

std::vector<JobRecord> SqliteJobStore::unfinished_jobs() {
  const std::lock_guard lock(mutex_);
  return list_unfinished_jobs(db_);
}

std::optional<JobRecord> SqliteJobStore::latest_job(std::string_view model, std::string_view kind) {
  const std::lock_guard lock(mutex_);
  return find_latest_job(db_, model, kind);
}

void SqliteJobStore::update_job(const JobRecord& job) {
  const std::lock_guard lock(mutex_);
  write_job(db_, job);
}

std::optional<std::vector<std::string>> SqliteJobStore::finish_import(const JobRecord& job, const ModelRecord& facts,
                                                                      const std::vector<ArtefactRecord>& artefacts,
                                                                      const std::optional<Turn>& turn) {
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

std::optional<std::vector<std::string>> SqliteJobStore::finish_parametrization(
    const JobRecord& job, const PackageRecord& package, const std::vector<PartRecord>& parts,
    const std::vector<std::string>& warnings, const std::optional<FindingCounts>& findings,
    const std::vector<ArtefactRecord>& artefacts, const FrameUpdate& frame) {
  const std::lock_guard lock(mutex_);
  Transaction transaction(db_);
  auto model = find_model(db_, job.model);
  if (!model) return std::nullopt;
  const auto old_hashes = hashes_of(db_, job.model);
  Statement(db_, "DELETE FROM artefacts WHERE model = ? AND of_package = 1").bind(job.model).run();
  // A turned model has a new preview and new positions, which are not part of the package and are kept when it is
  // replaced.
  for (const auto& artefact : artefacts)
    insert_artefact(db_, job.model, artefact, artefact.name != "preview.glb" && artefact.name != "positions");
  Statement(db_, "INSERT OR REPLACE INTO packages VALUES(?,?,?,?,?,?,?)")
      .bind(job.model, package.parametrization, package.created, package.metric, package.weights, package.weight_bits,
            write_levels(package.levels))
      .run();
  // A role that a user set during the job is kept.
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

bool SqliteJobStore::finish_proposal(const JobRecord& job, const std::vector<FeaturePointRecord>& proposals) {
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

std::vector<std::string> SqliteJobStore::finish_job(const JobRecord& job) {
  const std::lock_guard lock(mutex_);
  Transaction transaction(db_);
  write_job(db_, job);
  auto orphans = delete_job_files(db_, job.id);
  transaction.commit();
  return orphans;
}

std::vector<std::string> SqliteJobStore::finish_failed_import(const JobRecord& job) {
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

std::vector<std::string> SqliteJobStore::finish_extraction(const JobRecord& job, const SetRecord& set) {
  const std::lock_guard lock(mutex_);
  Transaction transaction(db_);
  insert_set(db_, set);
  write_job(db_, job);
  auto orphans = delete_job_files(db_, job.id);
  transaction.commit();
  return orphans;
}

bool SqliteJobStore::request_cancel(std::string_view job) {
  const std::lock_guard lock(mutex_);
  return mark_cancelled(db_, job);
}

}  // namespace semblante::store
