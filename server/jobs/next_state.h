#pragma once

#include <cstdint>

#include "server/http/problem.h"
#include "server/store/records.h"

namespace semblante::jobs {

/// The next state of a job, to be stored.
struct NextState {
  store::JobRecord shown, next;   ///< as answers show the job until then, and what is to be stored
  std::uint64_t room_needed = 0;  ///< free bytes before it is queued again
  bool first_in_line = false;     ///< when it is queued again
  bool cancel = false;            ///< requested after `next` was set
};

/// A job with this end.
store::JobRecord ended_job(store::JobRecord job, store::JobState state, const http::Problem& problem);
NextState ending(const store::JobRecord& job, store::JobState state, const http::Problem& problem);

/// A job that could not write to the disk and is queued again; the attempt is not counted. `disk_full`: because it is
/// full; false: because it fails.
NextState waiting_for_disk(const store::JobRecord& job, bool disk_full, std::uint64_t room_needed);
/// The end of a job that could not write to the disk in so many attempts.
NextState failed_by_disk(const store::JobRecord& job, bool disk_full, std::uint32_t attempts);

}  // namespace semblante::jobs
