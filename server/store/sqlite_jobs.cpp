#include "server/store/sqlite_jobs.h"

#include <string>

#include "server/store/facts_json.h"

namespace semblante::store {
namespace {

constexpr const char* job_columns =
    "SELECT id, model, kind, state, progress, stage, created, updated, problem, metric, weights, weight_bits, "
    "attempts, "
    "result, lods, extraction FROM jobs ";

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
  job.extraction = read_extraction(row.text(15));
  return job;
}

}  // namespace

void insert_job(Database& db, const JobRecord& job) {
  const auto model = job.model.empty() ? std::nullopt : std::optional(job.model);
  Statement(db, "INSERT INTO jobs VALUES(NULL,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?)")
      .bind(job.id, model, static_cast<int>(job.kind), static_cast<int>(job.state), job.progress, job.stage,
            job.created, job.updated, job.problem, job.metric, job.weights, job.weight_bits, job.attempts, job.result,
            write_lods(job.lods), write_extraction(job.extraction))
      .run();
  if (!job.extraction) return;
  for (const auto& hash : {job.extraction->expression_sha256, job.extraction->neutral_sha256}) {
    if (!hash.empty()) Statement(db, "INSERT OR IGNORE INTO job_files VALUES(?,?)").bind(job.id, hash).run();
  }
}

void write_job(Database& db, const JobRecord& job) {
  Statement(db,
            "UPDATE jobs SET state = ?, progress = ?, stage = ?, updated = ?, problem = ?, attempts = ?, result = ? "
            "WHERE id = ?")
      .bind(static_cast<int>(job.state), job.progress, job.stage, job.updated, job.problem, job.attempts, job.result,
            job.id)
      .run();
}

std::optional<JobRecord> find_job(Database& db, std::string_view id) {
  Statement statement(db, std::string(job_columns) + "WHERE id = ?");
  statement.bind(id);
  if (!statement.step()) return std::nullopt;
  return read_job(statement);
}

std::optional<JobRecord> find_latest_job(Database& db, std::string_view model, JobKind kind) {
  Statement statement(db, std::string(job_columns) + "WHERE model = ? AND kind = ? ORDER BY number DESC LIMIT 1");
  statement.bind(model, static_cast<int>(kind));
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
