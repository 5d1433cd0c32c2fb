#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>

namespace semblante::access {

/// Counts what each client has at the same time. Any thread. A client that has nothing takes no memory.
class Shares {
 public:
  /// One more of the client's, until the pointer and its copies are gone; null if it has `most` already. The shares
  /// must outlive it.
  [[nodiscard]] std::shared_ptr<const void> take(const std::string& client, std::uint64_t most) {
    const std::lock_guard lock(mutex_);
    const auto at = counts_.try_emplace(client, 0).first;
    if (at->second >= most) {
      if (at->second == 0) counts_.erase(at);
      return nullptr;
    }
    ++at->second;
    return {this, [this, client](const void*) { give_back(client); }};
  }
  [[nodiscard]] std::uint64_t of(const std::string& client) const {
    const std::lock_guard lock(mutex_);
    const auto found = counts_.find(client);
    return found == counts_.end() ? 0 : found->second;
  }

 private:
  void give_back(const std::string& client) {
    const std::lock_guard lock(mutex_);
    const auto found = counts_.find(client);
    if (--found->second == 0) counts_.erase(found);
  }

  mutable std::mutex mutex_;
  std::map<std::string, std::uint64_t> counts_;
};

}  // namespace semblante::access
