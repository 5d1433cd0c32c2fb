#include "server/streams/batch_sender.h"

#include <utility>

namespace semblante::streams {

using Clock = Stream::Clock;

void BatchSender::wake(std::weak_ptr<Stream> stream, Clock::time_point when) {
  bool is_next = false;
  {
    const std::lock_guard lock(mutex_);
    is_next = turns_.empty() || when < turns_.top().when;
    turns_.push({when, std::move(stream)});
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
        // A copy: it is read again after the wait, and the turns may have moved by then.
        const auto next = turns_.top().when;
        changed_.wait_until(lock, next);
      }
      continue;
    }
    Turn turn = std::move(ready.front());
    ready.pop_front();
    lock.unlock();
    if (const auto stream = turn.stream.lock())
      turn.when = stream->work(turn.when);
    else
      turn.when = Clock::time_point::max();
    lock.lock();
    if (turn.when == Clock::time_point::max()) continue;
    if (turn.when <= now)
      ready.push_back(std::move(turn));
    else
      turns_.push(std::move(turn));
  }
}

}  // namespace semblante::streams
