#pragma once

#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <queue>
#include <thread>
#include <vector>

#include "server/http/group_sender.h"
#include "server/streams/stream.h"

namespace semblante::streams {

/// The thread that closes batches when they are due and sends them. It sends one slice at a time, alternating between
/// all streams with something to send, so that a stream with thousands of subscribers delays another by one slice at
/// most.
class BatchSender {
 public:
  /// `group_sender` is used on this thread only; null: one call for each message.
  explicit BatchSender(std::unique_ptr<http::GroupSender> group_sender = nullptr);
  ~BatchSender() { stop(); }
  BatchSender(const BatchSender&) = delete;
  BatchSender& operator=(const BatchSender&) = delete;

  /// Schedules a call of stream->work(when) at that time. Any thread.
  void wake(std::weak_ptr<Stream> stream, Stream::Clock::time_point when);
  /// For Stream::work.
  [[nodiscard]] http::GroupSender& group_sender() { return *group_sender_; }
  /// Ends the thread; nothing is sent after it returns. Must not be called by the thread itself.
  void stop();

 private:
  struct Turn {
    Stream::Clock::time_point when;
    Stream::Clock::time_point asked;  ///< the stream asked for this time: `when`, or earlier after a fault
    std::weak_ptr<Stream> stream;
    bool operator<(const Turn& other) const { return when > other.when; }  ///< so that the earliest is on top
  };
  void run();

  const std::unique_ptr<http::GroupSender> group_sender_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::priority_queue<Turn> turns_;
  bool stopping_ = false;
  std::thread thread_;
};

}  // namespace semblante::streams
