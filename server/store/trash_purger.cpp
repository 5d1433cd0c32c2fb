#include "server/store/trash_purger.h"

#include <condition_variable>
#include <mutex>
#include <utility>

#include "server/log/guard.h"

namespace semblante::store {

TrashPurger::TrashPurger(Trash& trash, std::chrono::milliseconds interval, OnPurged on_purged)
    : thread_([&trash, interval, on_purged = std::move(on_purged)](const std::stop_token& stop) {
        std::mutex mutex;
        std::condition_variable_any stopped;
        std::unique_lock lock(mutex);
        while (!stop.stop_requested()) {
          log::guarded("purging the trash", [&] {
            const auto removed = trash.purge(std::chrono::system_clock::now(), stop);
            if (removed.files > 0) on_purged(removed);
          });
          stopped.wait_for(lock, stop, interval, [] { return false; });
        }
      }) {}

}  // namespace semblante::store
