#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <string>

#include "server/http/feed.h"
#include "server/jobs/job_queue.h"

namespace semblante::api {

/// The changes of one job as Server-Sent Events: `progress` with the newest state (states that were not sent in time
/// are skipped), then one `done`, `failed` or `cancelled`, then the end. Owned by its connection.
class JobEvents : public http::Feed {
 public:
  /// nullptr when there is no such job.
  static std::shared_ptr<JobEvents> open(jobs::JobQueue& queue, const std::string& id);
  ~JobEvents() override;
  JobEvents(const JobEvents&) = delete;
  JobEvents& operator=(const JobEvents&) = delete;

  void attach(std::function<void()> wake) override;
  std::optional<http::FeedItem> take() override;
  [[nodiscard]] bool finished() const override;

 private:
  /// Written by the queue's threads, read by the connection.
  struct Shared {
    std::mutex mutex;
    std::function<void()> wake;
    std::optional<store::JobRecord> newest;
    bool finished = false;
  };
  explicit JobEvents(jobs::JobQueue& queue) : queue_(queue), shared_(std::make_shared<Shared>()) {}
  static void put(Shared& shared, const store::JobRecord& job);

  jobs::JobQueue& queue_;
  std::shared_ptr<Shared> shared_;
  std::uint64_t watch_ = 0;
  std::uint64_t number_ = 0;
};

}  // namespace semblante::api
