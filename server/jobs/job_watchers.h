#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>

#include "server/store/records.h"

namespace semblante::jobs {

/// Who is told of the changes of a job. Any thread.
class JobWatchers {
 public:
  using Watcher = std::function<void(const store::JobRecord&)>;

  /// Returns the number for remove().
  std::uint64_t add(std::string_view job, Watcher watcher);
  /// The watcher is not called after this returns.
  void remove(std::uint64_t number);
  /// Calls the watchers of this job.
  void tell(const store::JobRecord& job);

 private:
  std::mutex mutex_;  ///< held while watchers are called
  std::uint64_t next_ = 1;
  std::map<std::uint64_t, std::pair<std::string, Watcher>> watchers_;
};

}  // namespace semblante::jobs
