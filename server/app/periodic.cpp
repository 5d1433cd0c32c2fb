#include "server/app/periodic.h"

#include <condition_variable>
#include <mutex>
#include <utility>

#include "server/log/guard.h"

namespace semblante {

Periodic::Periodic(std::string what, std::chrono::milliseconds interval, std::function<void()> work)
    : thread_([what = std::move(what), interval, work = std::move(work)](const std::stop_token& stop) {
        std::mutex mutex;
        std::condition_variable_any stopped;
        std::unique_lock lock(mutex);
        while (!stopped.wait_for(lock, stop, interval, [&] { return stop.stop_requested(); })) log::guarded(what, work);
      }) {}

}  // namespace semblante
