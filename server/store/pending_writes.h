#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <list>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "server/store/disk_space.h"
#include "server/store/store_error.h"

namespace semblante::store {

/// Whether the store can be written, and what waits until it can.
struct PendingStatus {
  bool writable = true;  ///< false from a write that failed until everything pending is done and a small write succeeds
  bool disk_full = false;         ///< why it is not writable; else another fault of the disk
  std::size_t count = 0;          ///< pending writes
  std::vector<std::string> what;  ///< of the first few: "the end of job 4f..."
};

/// Keeps what must reach the store and could not, and retries it until it is durable, on a thread of its own, with a
/// growing delay. Writes of one resource are done in the order they came. Everything that is not a client's to repeat
/// is written through here: how jobs and recordings ended, what a start found unfinished, the steps of the sample.
/// Bounded by its callers, who have at most one write pending for each job, recording and step. Any thread.
class PendingWrites {
 public:
  using Write = std::function<void()>;

  struct Options {
    Write probe;                     ///< a small durable write; throws StoreError. Empty: none
    DiskReserve* reserve = nullptr;  ///< freed for what is written through here; filled again before `writable`
    std::chrono::milliseconds first_delay{200}, longest_delay{5000};
  };

  explicit PendingWrites(Options options);
  ~PendingWrites();
  PendingWrites(const PendingWrites&) = delete;
  PendingWrites& operator=(const PendingWrites&) = delete;

  /// Calls `write` now, or, when an earlier write of `resource` is pending or this one throws, again later until it
  /// returns. It must change nothing when it throws. True when it is done. `what` names it for people.
  bool write(const void* owner, std::string resource, std::string what, Write write);

  /// Tries the writes of `owner` once more and forgets those that fail again: the next start finds what they were for.
  /// None of them is called any more when this returns.
  void release(const void* owner);

  /// Calls a client's change that makes room or ends something, with the reserve freed for it if the disk is full.
  /// Throws as `change` does.
  template <class Change>
  auto with_reserve(Change&& change) {
    try {
      return change();
    } catch (const NotEnoughRoom&) {
      throw;
    } catch (const DiskFull& fault) {
      if (!release_reserve(fault)) throw;
    }
    return change();
  }

  /// A write failed that nobody keeps: the store counts as not writable until a probe succeeds.
  void note(const std::exception& fault);

  [[nodiscard]] PendingStatus status() const;

 private:
  struct Item {
    const void* owner;
    std::string resource, what;
    Write write;
    std::uint64_t number = 0;  ///< rises
    bool busy = false;         ///< it is being tried
  };
  struct Fault {
    bool disk_full = false;
    std::string message;
  };
  using Lock = std::unique_lock<std::mutex>;

  void run();
  bool attempt(Lock& lock, std::list<Item>::iterator item);
  void attempt_all(Lock& lock, const void* owner);
  void probe(Lock& lock);
  void note(const Lock& lock, const std::exception& fault);
  bool release_reserve(const DiskFull& fault);
  /// Neither being tried nor behind another of its resource.
  [[nodiscard]] bool is_ready(const Item& item) const;

  const Options options_;
  mutable std::mutex mutex_;  ///< guards what follows; not held while a write is tried
  std::condition_variable changed_;
  std::list<Item> items_;
  std::uint64_t next_number_ = 1;
  std::optional<Fault> fault_;
  std::size_t recorded_ = 0;  ///< since the fault began
  bool stopping_ = false;
  std::thread thread_;
};

}  // namespace semblante::store
