#include "server/jobs/job_queue.h"

#include <algorithm>
#include <mutex>
#include <utility>

#include "server/log/guard.h"
#include "server/log/log.h"

namespace semblante::jobs {

using store::JobRecord;
using store::JobState;

JobQueue::JobQueue(store::Store& store, store::BlobStore& blobs, store::PendingWrites& pending, JobConfig config)
    : store_(store), blobs_(blobs), pending_(pending), config_(std::move(config)) {}

JobQueue::~JobQueue() { stop(); }

void JobQueue::start() {
  for (auto& job : store_.unfinished_jobs()) {
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
    return pending_.with_reserve([&] { return store_.request_cancel(id); }) ? Cancelled::recorded : Cancelled::none;
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
  return store_.job(id);
}

std::uint64_t JobQueue::watch(std::string_view id, Watcher watcher) {
  const std::lock_guard lock(watch_mutex_);
  watchers_.emplace(next_watch_, std::make_pair(std::string(id), std::move(watcher)));
  return next_watch_++;
}

void JobQueue::unwatch(std::uint64_t watch) {
  const std::lock_guard lock(watch_mutex_);
  watchers_.erase(watch);
}

void JobQueue::publish(const JobRecord& job) {
  const std::lock_guard lock(watch_mutex_);
  for (const auto& [number, entry] : watchers_)
    if (entry.first == job.id) entry.second(job);
}

void JobQueue::conclude(const JobRecord& job) {
  if (const auto kind = find_job_kind(job.kind)) ++ended_[*kind][static_cast<std::size_t>(job.state)];
  if (job.state != JobState::done)
    log::info("job " + job.id + " (" + job.kind + " of " + job.model + ") " + std::string(store::to_string(job.state)) +
              ": " + http::problem_from_json(job.problem).detail);
  {
    const std::lock_guard lock(mutex_);
    shortages_.erase(job.id);
  }
  publish(job);
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

std::optional<JobQueue::Unrecorded> JobQueue::attempt(Running& running) {
  JobRun attempt(store_, blobs_, config_);
  try {
    auto ended = run_once(running, attempt);
    if (!ended) return std::nullopt;
    auto shown = running.job;
    shown.stage = "saving";
    return Unrecorded{shown, std::move(*ended)};
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
  store_.update_job(running.job);
  publish(running.job);
  const auto on_progress = [&](const WorkerProgress& line) {
    JobRecord copy;
    {
      const std::lock_guard lock(mutex_);
      running.job.progress = std::clamp(line.progress, running.job.progress, 1.0);
      running.job.stage = line.stage;
      running.job.updated = store::timestamp_now();
      copy = running.job;
    }
    publish(copy);
  };
  const auto wish = [&] {
    const std::lock_guard lock(mutex_);
    return stopping_ ? Wish::stop : running.cancel ? Wish::cancel : Wish::go_on;
  };
  return attempt.run(running.job, on_progress, wish);
}

}  // namespace semblante::jobs
