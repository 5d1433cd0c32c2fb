#pragma once

#include <functional>
#include <memory>

#include <boost/asio/awaitable.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>

#include "server/net/error_value.h"

namespace semblante::net {

/// Lets any thread wake one coroutine that waits on its own strand. The flag is used on that strand only, so a wake
/// between two waits is never lost.
class Waker : public std::enable_shared_from_this<Waker> {
 public:
  explicit Waker(const boost::asio::any_io_executor& strand) : timer_(strand) {}

  /// The function to pass to a Feed. It keeps the waker alive, not the connection.
  std::function<void()> function() {
    return [self = shared_from_this()] {
      boost::asio::post(self->timer_.get_executor(), [self] {
        self->signalled_ = true;
        self->timer_.cancel();
        if (self->on_wake_) self->on_wake_();
      });
    };
  }

  /// Called on the strand at every wake, waiting or not. Reset it before the objects it refers to are destroyed.
  void set_on_wake(std::function<void()> on_wake) { on_wake_ = std::move(on_wake); }

  /// Returns at the next wake, immediately if there was one since the last wait, or after `limit`.
  boost::asio::awaitable<void> wait(std::chrono::steady_clock::duration limit) {
    if (!signalled_) {
      timer_.expires_after(limit);
      boost::system::error_code ignored;  // a wake cancels the wait
      co_await timer_.async_wait(error_into(ignored));
    }
    signalled_ = false;
  }

 private:
  boost::asio::steady_timer timer_;
  bool signalled_ = false;
  std::function<void()> on_wake_;
};

}  // namespace semblante::net
