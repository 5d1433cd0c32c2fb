#include "server/store/sqlite_jobs.h"

#include <algorithm>
#include <string>

#include "server/store/sqlite_artefacts.h"

namespace semblante::store {
namespace {

constexpr const char* job_columns =
    "SELECT id, model, kind, state, progress, stage, created, updated, problem, attempts, request, result, owner, "
    "request_id FROM jobs ";

JobRecord read_job(const Statement& row) {
  JobRecord job;
  job.id = row.text(0);
  job.model = row.text(1);
  job.kind = row.text(2);
  job.state = row.one_of(JobState::cancelled, 3);
  job.progress = std::clamp(row.real(4), 0.0, 1.0);
  job.stage = row.text(5);
  job.created = row.text(6);
  job.updated = row.text(7);
  job.problem = row.json(8);
  job.attempts = row.whole<std::uint32_t>(9);
  job.request = row.json(10);
  job.result = row.json(11);
  job.origin = {row.text(12), row.text(13)};
  return job;
}

}  // namespace

void insert_job(Database& db, const JobRecord& job) {
  const auto model = job.model.empty() ? std::nullopt : std::optional(job.model);
  Statement(db,
            "INSERT INTO jobs(id, model, kind, state, progress, stage, created, updated, problem, attempts, request, "
            "result, owner, request_id) VALUES(?,?,?,?,?,?,?,?,?,?,?,?,?,?)")
      .bind(job.id, model, job.kind, static_cast<int>(job.state), job.progress, job.stage, job.created, job.updated,
            job.problem, job.attempts, job.request, job.result, job.origin.owner, job.origin.request)
      .run();
}

void insert_job_files(Database& db, std::string_view job, const std::vector<std::string>& hashes) {
  for (const auto& hash : hashes) Statement(db, "INSERT OR IGNORE INTO job_files VALUES(?,?)").bind(job, hash).run();
}

void write_job(Database& db, const JobRecord& job) {
  // Keeps the cancelling stage until the job ends.
  Statement(db,
            "UPDATE jobs SET state = ?1, progress = ?2, stage = CASE WHEN stage = ?3 AND ?1 IN (0, 1) THEN stage ELSE "
            "?4 END, updated = ?5, problem = ?6, attempts = ?7, result = ?8 WHERE id = ?9")
      .bind(static_cast<int>(job.state), job.progress, cancelling_stage, job.stage, job.updated, job.problem,
            job.attempts, job.result, job.id)
      .run();
}

bool mark_cancelled(Database& db, std::string_view id) {
  Statement(db, "UPDATE jobs SET stage = ?, updated = ? WHERE id = ? AND state IN (0, 1)")
      .bind(cancelling_stage, timestamp_now(), id)
      .run();
  return db.changes() != 0;
}

std::vector<std::string> delete_job_files(Database& db, std::string_view job) {
  std::vector<std::string> hashes;
  {
    Statement statement(db, "SELECT sha256 FROM job_files WHERE job = ?");
    statement.bind(job);
    while (statement.step()) hashes.push_back(statement.text(0));
  }
  Statement(db, "DELETE FROM job_files WHERE job = ?").bind(job).run();
  return without_reference(db, hashes);
}

std::optional<JobRecord> find_job(Database& db, std::string_view id) {
  Statement statement(db, std::string(job_columns) + "WHERE id = ?");
  statement.bind(id);
  if (!statement.step()) return std::nullopt;
  return read_job(statement);
}

std::optional<JobRecord> find_latest_job(Database& db, std::string_view model, std::string_view kind) {
  Statement statement(db, std::string(job_columns) + "WHERE model = ? AND kind = ? ORDER BY number DESC LIMIT 1");
  statement.bind(model, kind);
  if (!statement.step()) return std::nullopt;
  return read_job(statement);
}

std::vector<JobRecord> list_unfinished_jobs(Database& db) {
  std::vector<JobRecord> list;
  Statement statement(db, std::string(job_columns) + "WHERE state IN (0, 1) ORDER BY number");
  while (statement.step()) list.push_back(read_job(statement));
  return list;
}

}  // namespace semblante::store
