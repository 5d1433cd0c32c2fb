#pragma once

// Private to net/.

#include <string_view>
#include <thread>
#include <vector>

#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/io_context.hpp>

#include "server/log/guard.h"
#include "server/log/thread_rank.h"

namespace semblante::net {

/// Runs the context until it is stopped or has no more work. An exception of a handler is logged, and the others
/// continue: its operation is finished, so the objects it owned (its connection) are released.
inline void run_guarded(boost::asio::io_context& io, std::string_view who) {
  while (!log::guarded(who, [&io] { io.run(); })) {
  }
}

/// The threads that run the handlers of the application. Like asio::thread_pool, but an exception of a handler does not
/// end the process.
class WorkerPool {
 public:
  explicit WorkerPool(unsigned threads) : io_(static_cast<int>(threads)), work_(io_.get_executor()) {
    try {
      for (unsigned i = 0; i < threads; ++i)
        threads_.emplace_back([this] {
          log::set_thread_rank(log::ThreadRank::requests);
          run_guarded(io_, "worker thread");
        });
    } catch (...) {  // the system gives no more threads
      stop();
      join();
      throw;
    }
  }
  ~WorkerPool() {
    stop();
    join();
  }
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;

  [[nodiscard]] boost::asio::io_context::executor_type executor() { return io_.get_executor(); }
  /// Drops handlers that have not started.
  void stop() { io_.stop(); }
  /// Waits for all handlers of the pool. One thread at a time.
  void join() {
    work_.reset();
    for (auto& thread : threads_) thread.join();
    threads_.clear();
  }

 private:
  boost::asio::io_context io_;
  boost::asio::executor_work_guard<boost::asio::io_context::executor_type> work_;
  std::vector<std::thread> threads_;
};

}  // namespace semblante::net
