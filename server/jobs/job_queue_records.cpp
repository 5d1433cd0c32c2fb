// JobQueue's other half: the next state of a job after an attempt, and how it is stored.
#include <mutex>
#include <shared_mutex>
#include <utility>

#include "server/jobs/job_queue.h"
#include "server/log/log.h"

namespace semblante::jobs {

using store::JobRecord;
using store::JobState;

JobQueue::Unrecorded JobQueue::after_store_error(const Running& running, const JobRun& attempt,
                                                 const store::StoreError& fault) {
  const JobRecord& job = running.job;
  if (running.cancel)
    return ending(job, JobState::cancelled, http::make_problem("cancelled", "it was cancelled while it ran"));
  const bool disk_full = dynamic_cast<const store::DiskFull*>(&fault) != nullptr;
  std::uint32_t shortages = 0;
  {
    const std::lock_guard lock(mutex_);
    shortages = shortages_[job.id] += attempt.has_begun() ? 1 : 0;
  }
  log::warning("job " + job.id + " waits for the disk: " + fault.what());
  if (shortages >= config_.max_attempts)
    return ending(job, JobState::failed,
                  disk_full ? http::make_problem("insufficient-storage", "the disk had no room for what it makes, " +
                                                                             std::to_string(shortages) + " times")
                            : http::make_problem("storage-unavailable", "what it makes could not be written, " +
                                                                            std::to_string(shortages) + " times"));
  Unrecorded again{job, job, attempt.room_needed(), true};
  again.next.state = JobState::queued;
  again.next.progress = 0.0;
  again.next.stage = disk_full ? "waiting for disk space" : "waiting for the disk";
  again.next.updated = store::timestamp_now();
  --again.next.attempts;  // not counted: the job is not the cause of the failure
  again.shown = again.next;
  return again;
}

JobQueue::Unrecorded JobQueue::ending(const JobRecord& job, JobState state, const http::Problem& problem) {
  Unrecorded unrecorded{job, ended_job(job, state, problem)};
  unrecorded.shown.stage = "saving";
  return unrecorded;
}

bool JobQueue::record(Unrecorded unrecorded) {
  const auto id = unrecorded.next.id;
  const auto shown = unrecorded.shown;
  const std::string what = (store::is_final(unrecorded.next.state) ? "the end of job " : "that it waits, of job ") + id;
  {
    const std::lock_guard lock(mutex_);
    if (const auto found = running_.find(id); found != running_.end()) {
      unrecorded.cancel = unrecorded.cancel || found->second->cancel;
      running_.erase(found);
    }
    unrecorded_[id] = std::move(unrecorded);
  }
  changed_.notify_all();
  if (pending_.write(this, "job " + id, what, [this, id] { settle(id); })) return true;
  publish(shown);
  return false;
}

void JobQueue::write_next(const JobRecord& next, std::uint64_t room_needed) {
  if (store::is_final(next.state)) {
    const std::unique_lock alone(blobs_.references());
    for (const auto& hash : finish_without_outcome(next, store_)) blobs_.remove(hash);
    return;
  }
  if (store::free_bytes(blobs_.temporary()) < room_needed)
    throw store::NotEnoughRoom("job " + next.id + " needs about " + std::to_string(room_needed) + " bytes");
  store_.update_job(next);
}

void JobQueue::settle(const std::string& id) {
  JobRecord next;
  bool is_recorded = false;
  while (!is_recorded) {
    std::uint64_t room_needed = 0;
    {
      const std::lock_guard lock(mutex_);
      auto& unrecorded = unrecorded_.at(id);
      if (unrecorded.cancel && !store::is_final(unrecorded.next.state))
        unrecorded.next = ended_job(unrecorded.next, JobState::cancelled,
                                    http::make_problem("cancelled", "it was cancelled while it waited for the disk"));
      next = unrecorded.next;
      room_needed = unrecorded.room_needed;
    }
    write_next(next, room_needed);
    const std::lock_guard lock(mutex_);
    const auto found = unrecorded_.find(id);
    if (found->second.cancel && !store::is_final(next.state)) continue;  // cancelled meanwhile
    if (!store::is_final(next.state)) {
      if (found->second.first_in_line)
        queue_.push_front(next);
      else
        queue_.push_back(next);
    }
    unrecorded_.erase(found);
    is_recorded = true;
  }
  changed_.notify_all();
  if (store::is_final(next.state))
    conclude(next);
  else
    publish(next);
}

}  // namespace semblante::jobs
