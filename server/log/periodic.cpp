#include "server/log/periodic.h"

#include <condition_variable>
#include <mutex>
#include <utility>

#include "server/log/guard.h"

namespace semblante::log {

Periodic::Periodic(std::string what, std::chrono::milliseconds interval, Work work, First first)
    : thread_([what = std::move(what), interval, work = std::move(work), first](const std::stop_token& stop) {
        std::mutex mutex;
        std::condition_variable_any stopped;
        std::unique_lock lock(mutex);
        if (first == First::at_once) guarded(what, [&] { work(stop); });
        while (!stopped.wait_for(lock, stop, interval, [&] { return stop.stop_requested(); }))
          guarded(what, [&] { work(stop); });
      }) {}

}  // namespace semblante::log
