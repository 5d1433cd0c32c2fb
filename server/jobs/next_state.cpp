#include "server/jobs/next_state.h"

#include <string>
#include <utility>

namespace semblante::jobs {

using store::JobRecord;
using store::JobState;

JobRecord ended_job(JobRecord job, JobState state, const http::Problem& problem) {
  job.state = state;
  job.problem = http::to_json(problem);
  job.updated = store::timestamp_now();
  return job;
}

NextState ending(const JobRecord& job, JobState state, const http::Problem& problem) {
  NextState after{job, ended_job(job, state, problem)};
  after.shown.stage = "saving";
  return after;
}

NextState waiting_for_disk(const JobRecord& job, bool disk_full, std::uint64_t room_needed) {
  JobRecord again = job;
  again.state = JobState::queued;
  again.progress = 0.0;
  again.stage = disk_full ? "waiting for disk space" : "waiting for the disk";
  again.updated = store::timestamp_now();
  --again.attempts;  // not counted: the job is not the cause of the failure
  return {again, again, room_needed, true};
}

NextState failed_by_disk(const JobRecord& job, bool disk_full, std::uint32_t attempts) {
  const auto times = std::to_string(attempts) + " times";
  return ending(job, JobState::failed,
                disk_full
                    ? http::make_problem("insufficient-storage", "the disk had no room for what it makes, " + times)
                    : http::make_problem("storage-unavailable", "what it makes could not be written, " + times));
}

}  // namespace semblante::jobs
