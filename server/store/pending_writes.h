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

/// Whether the store can be written, and the writes that are pending.
struct PendingStatus {
  bool writable = true;    ///< false from a failed write until all pending writes are done and a small write succeeds
  bool disk_full = false;  ///< the disk is full; false with `writable` false: another fault of the disk
  std::size_t count = 0;   ///< pending writes
  std::vector<std::string> what;  ///< descriptions of the first few: "the end of job 4f..."
};

/// Keeps failed writes to the store and retries them until they are durable, on its own thread, with a growing delay.
/// Writes of one resource are made in the order of their calls. Used for all writes that no client can repeat: the ends
/// of jobs and recordings, repairs at a start, the steps of the sample. The callers bound the number of pending writes:
/// at most one for each job, recording and step. Any thread.
class PendingWrites {
 public:
  using Write = std::function<void()>;

  struct Options {
    Write probe;                     ///< a small durable write; throws StoreError. Empty: none
    DiskReserve* reserve = nullptr;  ///< released for pending writes; filled again before the store counts as writable
    std::chrono::milliseconds first_delay{200}, longest_delay{5000};
  };

  explicit PendingWrites(Options options);
  ~PendingWrites();
  PendingWrites(const PendingWrites&) = delete;
  PendingWrites& operator=(const PendingWrites&) = delete;

  /// Calls `write` now; when it throws, or an earlier write of `resource` is pending, calls it later until it returns.
  /// `write` must change nothing when it throws. True when it is done. `what` describes it in log and /readyz.
  bool write(const void* owner, std::string resource, std::string what, Write write);

  /// Tries the writes of `owner` once more and drops those that fail again: the next start repairs their effects.
  /// None of them is called after this returns.
  void release(const void* owner);

  /// Calls a change that a client requested and that frees space or ends something. If the disk is full, releases the
  /// reserve and calls the change again. Throws what `change` throws.
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

  /// Reports a failed write that will not be retried here: the store counts as not writable until a probe succeeds.
  void note(const std::exception& fault);

  [[nodiscard]] PendingStatus status() const;

 private:
  struct Item {
    const void* owner;
    std::string resource, what;
    Write write;
    std::uint64_t number = 0;  ///< increases
    bool busy = false;         ///< an attempt is running
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
  /// Whether the item is neither running nor preceded by another write of its resource.
  [[nodiscard]] bool is_ready(const Item& item) const;

  const Options options_;
  mutable std::mutex mutex_;  ///< guards the members below; not held during a write
  std::condition_variable changed_;
  std::list<Item> items_;
  std::uint64_t next_number_ = 1;
  std::optional<Fault> fault_;
  std::size_t recorded_ = 0;  ///< number of completed writes since the fault began
  bool stopping_ = false;
  std::thread thread_;
};

}  // namespace semblante::store
