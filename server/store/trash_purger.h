#pragma once

#include <chrono>
#include <functional>
#include <thread>

#include "server/store/trash.h"

namespace semblante::store {

/// Purges the trash now and once per interval, on its own thread. From now on, others may only call counts() of the
/// trash. The destructor stops the purge between two files.
class TrashPurger {
 public:
  using OnPurged = std::function<void(const Trash::Counts& removed)>;  ///< on the thread, if any were removed
  TrashPurger(Trash& trash, std::chrono::milliseconds interval, OnPurged on_purged);

 private:
  std::jthread thread_;
};

}  // namespace semblante::store
