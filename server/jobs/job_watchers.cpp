#include "server/jobs/job_watchers.h"

namespace semblante::jobs {

std::uint64_t JobWatchers::add(std::string_view job, Watcher watcher) {
  const std::lock_guard lock(mutex_);
  watchers_.emplace(next_, std::make_pair(std::string(job), std::move(watcher)));
  return next_++;
}

void JobWatchers::remove(std::uint64_t number) {
  const std::lock_guard lock(mutex_);
  watchers_.erase(number);
}

void JobWatchers::tell(const store::JobRecord& job) {
  const std::lock_guard lock(mutex_);
  for (const auto& [number, entry] : watchers_)
    if (entry.first == job.id) entry.second(job);
}

}  // namespace semblante::jobs
