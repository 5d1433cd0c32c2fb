#include "server/jobs/job_queue.h"

#include <algorithm>
#include <mutex>
#include <shared_mutex>
#include <utility>

#include "server/log/guard.h"
#include "server/log/log.h"

namespace semblante::jobs {

using store::JobRecord;
using store::JobState;

JobQueue::JobQueue(JobStores stores, store::BlobStore& blobs, store::PendingWrites& pending, JobConfig config)
    : stores_(stores), blobs_(blobs), pending_(pending), config_(std::move(config)) {}

JobQueue::~JobQueue() { stop(); }

void JobQueue::start() {
  for (auto& job : stores_.jobs.unfinished_jobs()) {
    if (job.stage == store::cancelling_stage) {
      record(ending(job, JobState::cancelled, http::make_problem("cancelled", "it was cancelled while it ran")));
      continue;
    }
    if (job.attempts >= config_.max_attempts) {
      record(ending(job, JobState::failed,
                    http::make_problem("worker-crashed", "the server ended " + std::to_string(job.attempts) +
                                                             " times while this job ran; it is not tried again")));
      continue;
    }
    job.state = JobState::queued;
    job.progress = 0.0;
    job.stage.clear();
    record({job, job});
  }
  for (unsigned i = 0; i < config_.concurrency; ++i)
    threads_.emplace_back([this] { log::keep_running("a job queue thread", [this] { work(); }); });
}

void JobQueue::stop() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_all();
  for (auto& thread : threads_) thread.join();
  threads_.clear();
  pending_.release(this);
}

bool JobQueue::has_room() const {
  const std::lock_guard lock(mutex_);
  return queue_.size() + unrecorded_.size() < config_.max_queued;
}

std::size_t JobQueue::waiting() const {
  const std::lock_guard lock(mutex_);
  return queue_.size() + unrecorded_.size();
}

std::size_t JobQueue::running() const {
  const std::lock_guard lock(mutex_);
  return running_.size();
}

std::uint64_t JobQueue::ended(std::string_view kind, JobState state) const {
  const auto index = find_job_kind(kind);
  return index ? ended_[*index][static_cast<std::size_t>(state)].load() : 0;
}

void JobQueue::enqueue(const JobRecord& job) {
  {
    const std::lock_guard lock(mutex_);
    queue_.push_back(job);
  }
  changed_.notify_all();
}

Cancelled JobQueue::cancel(std::string_view id) {
  JobRecord job;
  bool runs = false;
  {
    const std::lock_guard lock(mutex_);
    if (const auto found = unrecorded_.find(id); found != unrecorded_.end()) {
      found->second.cancel = true;
      return Cancelled::pending;
    }
    if (const auto found = running_.find(id); found != running_.end()) {
      found->second->cancel = runs = true;
    } else {
      const auto waiting = std::find_if(queue_.begin(), queue_.end(), [&](const auto& item) { return item.id == id; });
      if (waiting == queue_.end()) return Cancelled::none;
      job = *waiting;
      queue_.erase(waiting);
    }
  }
  if (!runs) {
    const auto problem = http::make_problem("cancelled", "it was cancelled before it started");
    return record(ending(job, JobState::cancelled, problem)) ? Cancelled::recorded : Cancelled::pending;
  }
  try {
    return pending_.with_reserve([&] { return stores_.jobs.request_cancel(id); }) ? Cancelled::recorded
                                                                                  : Cancelled::none;
  } catch (const store::StoreError& fault) {
    pending_.note(fault);  // its end is stored when its worker has ended and the store can be written
    return Cancelled::pending;
  }
}

void JobQueue::cancel_all_of(std::string_view model) {
  std::vector<JobRecord> waiting;
  {
    const std::lock_guard lock(mutex_);
    for (const auto& job : queue_)
      if (job.model == model) waiting.push_back(job);
    std::erase_if(queue_, [&](const auto& job) { return job.model == model; });
    for (auto& [id, unrecorded] : unrecorded_)
      if (unrecorded.next.model == model) unrecorded.cancel = true;
  }
  const auto problem = http::make_problem("cancelled", "its model was removed before it started");
  for (const auto& job : waiting) record(ending(job, JobState::cancelled, problem));
  std::unique_lock lock(mutex_);
  const auto runs = [&] {
    return std::any_of(running_.begin(), running_.end(), [&](const auto& item) {
      if (item.second->job.model != model) return false;
      item.second->cancel = true;
      return true;
    });
  };
  changed_.wait(lock, [&] { return !runs(); });
}

std::optional<JobRecord> JobQueue::find(std::string_view id) const {
  {
    const std::lock_guard lock(mutex_);
    if (const auto found = running_.find(id); found != running_.end()) return found->second->job;
    if (const auto found = unrecorded_.find(id); found != unrecorded_.end()) return found->second.shown;
  }
  return stores_.jobs.job(id);
}

void JobQueue::conclude(const JobRecord& job) {
  const log::Scope scope({job.origin.request, job.id});
  if (const auto kind = find_job_kind(job.kind)) ++ended_[*kind][static_cast<std::size_t>(job.state)];
  if (job.state == JobState::done)
    log::debug("job " + job.id + " (" + job.kind + " of " + job.model + ") done");
  else
    log::info("job " + job.id + " (" + job.kind + " of " + job.model + ") " + std::string(store::to_string(job.state)) +
              ": " + http::problem_from_json(job.problem).detail);
  {
    const std::lock_guard lock(mutex_);
    shortages_.erase(job.id);
  }
  watchers_.tell(job);
  if (!on_finished_) return;
  log::guarded("after the end of job " + job.id, [&] { on_finished_(job); });
}

bool JobQueue::is_busy(const std::string& model) const {
  if (model.empty()) return false;
  return std::any_of(running_.begin(), running_.end(),
                     [&](const auto& item) { return item.second->job.model == model; }) ||
         std::any_of(unrecorded_.begin(), unrecorded_.end(),
                     [&](const auto& item) { return item.second.next.model == model; });
}

std::deque<JobRecord>::iterator JobQueue::next() {
  return std::find_if(queue_.begin(), queue_.end(), [&](const JobRecord& job) { return !is_busy(job.model); });
}

void JobQueue::work() {
  while (true) {
    auto running = std::make_shared<Running>();
    {
      std::unique_lock lock(mutex_);
      auto job = queue_.end();
      changed_.wait(lock, [&] { return stopping_ || (job = next()) != queue_.end(); });
      if (stopping_) return;
      running->job = std::move(*job);
      queue_.erase(job);
      running_[running->job.id] = running;
    }
    auto after = attempt(*running);
    if (after && after->next.state != JobState::done) {
      record(std::move(*after));
      continue;
    }
    {
      const std::lock_guard lock(mutex_);
      running_.erase(running->job.id);
    }
    changed_.notify_all();
    if (after) conclude(after->next);
  }
}

std::optional<NextState> JobQueue::attempt(Running& running) {
  const log::Scope scope({running.job.origin.request, running.job.id});
  JobRun attempt(stores_, blobs_, config_);
  try {
    auto ended = run_once(running, attempt);
    if (!ended) {
      // The end of the server is no fault of the job: this attempt does not count.
      --running.job.attempts;
      stores_.jobs.update_job(running.job);
      return std::nullopt;
    }
    auto shown = running.job;
    shown.stage = "saving";
    return NextState{shown, std::move(*ended)};
  } catch (const store::StoreError& fault) {
    return after_store_error(running, attempt, fault);
  } catch (...) {
    log::caught("job " + running.job.id);
    return ending(running.job, JobState::failed, http::make_problem("internal", "an internal error"));
  }
}

std::optional<JobRecord> JobQueue::run_once(Running& running, JobRun& attempt) {
  {
    const std::lock_guard lock(mutex_);
    running.job.state = JobState::running;
    running.job.stage = "starting";
    running.job.updated = store::timestamp_now();
    ++running.job.attempts;
  }
  stores_.jobs.update_job(running.job);
  watchers_.tell(running.job);
  const auto on_progress = [&](const WorkerProgress& line) {
    JobRecord copy;
    {
      const std::lock_guard lock(mutex_);
      running.job.progress = std::clamp(line.progress, running.job.progress, 1.0);
      running.job.stage = line.stage;
      running.job.updated = store::timestamp_now();
      copy = running.job;
    }
    watchers_.tell(copy);
  };
  const auto wish = [&] {
    const std::lock_guard lock(mutex_);
    return stopping_ ? Wish::stop : running.cancel ? Wish::cancel : Wish::go_on;
  };
  return attempt.run(running.job, on_progress, wish);
}

NextState JobQueue::after_store_error(const Running& running, const JobRun& attempt, const store::StoreError& fault) {
  const JobRecord& job = running.job;
  if (running.cancel)
    return ending(job, JobState::cancelled, http::make_problem("cancelled", "it was cancelled while it ran"));
  std::uint32_t shortages = 0;
  {
    const std::lock_guard lock(mutex_);
    shortages = shortages_[job.id] += attempt.has_begun() ? 1 : 0;
  }
  log::warning("job " + job.id + " waits for the disk: " + fault.what());
  const bool disk_full = dynamic_cast<const store::DiskFull*>(&fault) != nullptr;
  if (shortages >= config_.max_attempts) return failed_by_disk(job, disk_full, shortages);
  return waiting_for_disk(job, disk_full, attempt.room_needed());
}

bool JobQueue::record(NextState unrecorded) {
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
  watchers_.tell(shown);
  return false;
}

void JobQueue::write_next(const JobRecord& next, std::uint64_t room_needed) {
  if (store::is_final(next.state)) {
    const std::unique_lock alone(blobs_.references());
    for (const auto& hash : finish_without_outcome(next, stores_.jobs)) blobs_.remove(hash);
    return;
  }
  constexpr std::uint64_t files_needed = 64;  // its folder, and what it makes
  if (room_needed > 0 && store::free_files(blobs_.temporary()) < files_needed)
    throw store::NotEnoughRoom("job " + next.id + " needs about " + std::to_string(files_needed) + " files");
  if (store::free_bytes(blobs_.temporary()) < room_needed)
    throw store::NotEnoughRoom("job " + next.id + " needs about " + std::to_string(room_needed) + " bytes");
  stores_.jobs.update_job(next);
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
    watchers_.tell(next);
}

}  // namespace semblante::jobs
