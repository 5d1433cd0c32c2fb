#pragma once

#include <chrono>
#include <functional>
#include <thread>

#include "server/store/trash.h"

namespace semblante::store {

/// Purges the trash now and then once an interval, on a thread of its own. The trash is its alone from now on, but for
/// counts(). Ends, between two files, with the object.
class TrashPurger {
 public:
  using OnPurged = std::function<void(const Trash::Counts& removed)>;  ///< when something was; on the thread
  TrashPurger(Trash& trash, std::chrono::milliseconds interval, OnPurged on_purged);

 private:
  std::jthread thread_;
};

}  // namespace semblante::store
