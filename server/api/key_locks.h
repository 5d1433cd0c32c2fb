#pragma once

#include <chrono>
#include <condition_variable>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

namespace semblante::api {

/// A lock for each key, held by one request at a time. A key without holder and waiters takes no memory. Any thread
/// except I/O threads; must outlive the locks it has returned.
class KeyLocks {
  struct Lock {
    std::condition_variable released;
    std::size_t users = 0;  ///< the holder and the waiters
    bool held = false;
  };
  using Locks = std::map<std::string, Lock, std::less<>>;

 public:
  /// Holds the key until it is destroyed.
  class Held {
   public:
    Held(Held&& other) noexcept : owner_(std::exchange(other.owner_, nullptr)), lock_(other.lock_) {}
    Held(const Held&) = delete;
    Held& operator=(const Held&) = delete;
    Held& operator=(Held&&) = delete;
    ~Held();

   private:
    friend class KeyLocks;
    Held(KeyLocks& owner, Locks::iterator lock) : owner_(&owner), lock_(lock) {}
    KeyLocks* owner_;
    Locks::iterator lock_;
  };

  /// Waits until the key is free; nullopt when that takes longer than `limit`.
  std::optional<Held> acquire(std::string_view key, std::chrono::milliseconds limit);
  /// Keys that are held or waited for.
  [[nodiscard]] std::size_t size() const;

 private:
  mutable std::mutex mutex_;  ///< guards locks_ and its elements
  Locks locks_;
};

}  // namespace semblante::api
