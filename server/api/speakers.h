#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <semaphore>
#include <thread>

namespace semblante::api {

/// The threads that make the rest of a text which a stream already says. Of all of them only so many voices speak at
/// the same time; the others wait for their turn, sentence by sentence. Any thread.
class Speakers {
 public:
  /// A rest that is being made at the same time as others.
  static constexpr std::size_t most = 64;

  explicit Speakers(std::size_t voices) : turns_(static_cast<std::ptrdiff_t>(voices)) {}
  /// Ends what is being made.
  ~Speakers();
  Speakers(const Speakers&) = delete;
  Speakers& operator=(const Speakers&) = delete;

  /// A place that is free again when the pointer is reset; null when all are taken.
  [[nodiscard]] std::shared_ptr<void> place();
  /// Runs the work in a thread of its own, until which it holds the place.
  void start(std::shared_ptr<void> place, std::function<void()> work);
  /// Runs it when it is its turn, unless it is not wanted any more. `wanted` is asked several times per second.
  void take_turn(const std::function<bool()>& wanted, const std::function<void()>& work);
  [[nodiscard]] bool stopping() const { return stopping_; }

 private:
  struct Speaker {
    std::thread thread;
    std::shared_ptr<std::atomic<bool>> done;
  };
  /// Joins those that are done. With the mutex.
  void tidy();

  std::counting_semaphore<> turns_;
  std::atomic<bool> stopping_{false};
  std::shared_ptr<std::atomic<std::size_t>> taken_ = std::make_shared<std::atomic<std::size_t>>(0);
  std::mutex mutex_;
  std::list<Speaker> speakers_;
};

}  // namespace semblante::api
