#pragma once

// Private to store/: rows of jobs. Within the caller's transaction.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "server/store/records.h"
#include "server/store/sqlite.h"

namespace semblante::store {

void insert_job(Database& db, const JobRecord& job);
void insert_job_files(Database& db, std::string_view job, const std::vector<std::string>& hashes);
/// Writes the members of a job that change while it runs.
void write_job(Database& db, const JobRecord& job);
/// See JobStore::request_cancel.
bool mark_cancelled(Database& db, std::string_view id);
/// Returns the hashes that are no longer referred to.
std::vector<std::string> delete_job_files(Database& db, std::string_view job);
std::optional<JobRecord> find_job(Database& db, std::string_view id);
std::optional<JobRecord> find_latest_job(Database& db, std::string_view model, std::string_view kind);
/// Queued and running jobs, in order of creation.
std::vector<JobRecord> list_unfinished_jobs(Database& db);

}  // namespace semblante::store
