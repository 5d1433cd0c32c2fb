#include "server/api/job_events.h"

#include <nlohmann/json.hpp>

#include "server/api/representations.h"

namespace semblante::api {

std::shared_ptr<JobEvents> JobEvents::open(jobs::JobQueue& queue, const std::string& id) {
  std::shared_ptr<JobEvents> events(new JobEvents(queue));
  // Subscribes before it reads the state: a change between the two is reported twice rather than never.
  events->watch_ = queue.watch(id, [shared = events->shared_](const store::JobRecord& job) { put(*shared, job); });
  const auto job = queue.find(id);
  if (!job) return nullptr;
  put(*events->shared_, *job);
  return events;
}

JobEvents::~JobEvents() { queue_.unwatch(watch_); }

void JobEvents::put(Shared& shared, const store::JobRecord& job) {
  const std::lock_guard lock(shared.mutex);
  if (shared.finished) return;
  shared.newest = job;
  shared.finished = store::is_final(job.state);
  if (shared.wake) shared.wake();
}

void JobEvents::attach(std::function<void()> wake) {
  const std::lock_guard lock(shared_->mutex);
  shared_->wake = std::move(wake);
}

std::optional<http::FeedItem> JobEvents::take() {
  std::optional<store::JobRecord> job;
  {
    const std::lock_guard lock(shared_->mutex);
    job.swap(shared_->newest);
  }
  if (!job) return std::nullopt;
  const auto event = store::is_final(job->state) ? store::to_string(job->state) : std::string_view("progress");
  std::string text("id: ");
  text.append(std::to_string(++number_)).append("\nevent: ").append(event).append("\ndata: ");
  text.append(to_json(represent(*job)).dump(-1, ' ', false, Json::error_handler_t::replace)).append("\n\n");
  return http::FeedItem{std::make_shared<const std::string>(std::move(text))};
}

bool JobEvents::finished() const {
  const std::lock_guard lock(shared_->mutex);
  return shared_->finished && !shared_->newest;
}

}  // namespace semblante::api
