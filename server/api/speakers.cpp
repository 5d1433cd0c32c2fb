#include "server/api/speakers.h"

#include <chrono>
#include <utility>

#include "server/log/guard.h"
#include "server/log/thread_rank.h"

namespace semblante::api {
namespace {

constexpr std::chrono::milliseconds look_interval{50};

}  // namespace

Speakers::~Speakers() {
  stopping_ = true;
  for (auto& speaker : speakers_) speaker.thread.join();
}

std::shared_ptr<void> Speakers::place() {
  if (taken_->fetch_add(1) >= most) {
    taken_->fetch_sub(1);
    return nullptr;
  }
  return {taken_.get(), [taken = taken_](void*) { taken->fetch_sub(1); }};
}

void Speakers::start(std::shared_ptr<void> place, std::function<void()> work) {
  const std::lock_guard lock(mutex_);
  tidy();
  auto done = std::make_shared<std::atomic<bool>>(false);
  speakers_.push_back({std::thread([done, held = std::move(place), work = std::move(work)]() mutable {
                         log::set_thread_rank(log::ThreadRank::requests);
                         log::guarded("making the rest of a speech", work);
                         work = nullptr;
                         held.reset();
                         *done = true;
                       }),
                       done});
}

void Speakers::tidy() {
  for (auto at = speakers_.begin(); at != speakers_.end();) {
    if (!*at->done) {
      ++at;
      continue;
    }
    at->thread.join();
    at = speakers_.erase(at);
  }
}

void Speakers::take_turn(const std::function<bool()>& wanted, const std::function<void()>& work) {
  while (wanted()) {
    if (!turns_.try_acquire_for(look_interval)) continue;
    // Gives the turn back after an exception, too.
    const std::unique_ptr<std::counting_semaphore<>, void (*)(std::counting_semaphore<>*)> turn(
        &turns_, [](std::counting_semaphore<>* turns) { turns->release(); });
    work();
    return;
  }
}

}  // namespace semblante::api
