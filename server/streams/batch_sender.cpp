#include "server/streams/batch_sender.h"

#include <utility>

#include "server/log/guard.h"

namespace semblante::streams {

using Clock = Stream::Clock;

namespace {

/// Delay of a stream's next turn after a fault.
constexpr std::chrono::milliseconds retry_interval{200};

}  // namespace

BatchSender::BatchSender(std::unique_ptr<http::GroupSender> group_sender)
    : group_sender_(group_sender ? std::move(group_sender) : std::make_unique<http::GroupSender>()),
      thread_([this] { log::keep_running("the batch sender", [this] { run(); }); }) {}

void BatchSender::wake(std::weak_ptr<Stream> stream, Clock::time_point when) {
  bool is_next = false;
  {
    const std::lock_guard lock(mutex_);
    is_next = turns_.empty() || when < turns_.top().when;
    turns_.push({when, when, std::move(stream)});
  }
  if (is_next) changed_.notify_one();
}

void BatchSender::stop() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_one();
  if (thread_.joinable()) thread_.join();
}

void BatchSender::run() {
  std::deque<Turn> ready;
  std::unique_lock lock(mutex_);
  while (!stopping_) {
    const auto now = Clock::now();
    for (; !turns_.empty() && turns_.top().when <= now; turns_.pop()) ready.push_back(turns_.top());
    if (ready.empty()) {
      if (turns_.empty()) {
        changed_.wait(lock);
      } else {
        // A copy, because wait_until reads it again after the wait, when turns_ may have reallocated.
        const auto next = turns_.top().when;
        changed_.wait_until(lock, next);
      }
      continue;
    }
    Turn turn = std::move(ready.front());
    ready.pop_front();
    lock.unlock();
    const bool worked = log::guarded("sending a batch", [&turn] {
      const auto stream = turn.stream.lock();
      turn.when = turn.asked = stream ? stream->work(turn.asked) : Clock::time_point::max();
    });
    // `asked` stays: the stream still waits for the call that it asked for.
    if (!worked) turn.when = now + retry_interval;
    lock.lock();
    if (turn.when == Clock::time_point::max()) continue;
    if (turn.when <= now)
      ready.push_back(std::move(turn));
    else
      turns_.push(std::move(turn));
  }
}

}  // namespace semblante::streams
