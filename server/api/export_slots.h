#pragma once

#include <cstddef>
#include <memory>
#include <mutex>

namespace semblante::api {

/// Bounds what is made at the same time and keeps a worker thread busy for seconds: exports, speeches. Any thread.
class ExportSlots {
 public:
  explicit ExportSlots(std::size_t count) : free_(count) {}

  /// A slot that is free again when the pointer is reset; null when all are taken. Does not wait. The slots must
  /// outlive it.
  [[nodiscard]] std::unique_ptr<void, void (*)(void*)> take() {
    const std::lock_guard lock(mutex_);
    if (free_ == 0) return {nullptr, give_back};
    --free_;
    return {this, give_back};
  }

 private:
  static void give_back(void* self) {
    auto& slots = *static_cast<ExportSlots*>(self);
    const std::lock_guard lock(slots.mutex_);
    ++slots.free_;
  }

  std::mutex mutex_;
  std::size_t free_;
};

}  // namespace semblante::api
