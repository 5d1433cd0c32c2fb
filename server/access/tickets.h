#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

#include "server/access/rights.h"

namespace semblante::access {

/// One-shot replacements of a token in an address, for what cannot carry a header: a browser's WebSocket, a link to a
/// download. A ticket is for one path, is used once, and ends after a short time, so that it may stand in a log. Only
/// in memory. Any thread.
class Tickets {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::seconds lifetime{30};
  static constexpr std::size_t most = 10'000;

  /// nullopt when too many unused tickets are waiting.
  std::optional<std::string> issue(const Rights& rights, std::string path, Clock::time_point now = Clock::now());
  /// Uses the ticket up; nullopt when there is none for this path.
  std::optional<Rights> redeem(std::string_view ticket, std::string_view path, Clock::time_point now = Clock::now());

 private:
  struct Ticket {
    Rights rights;
    std::string path;
    Clock::time_point ends;
  };
  void forget_old(Clock::time_point now);

  std::mutex mutex_;
  std::map<std::string, Ticket, std::less<>> tickets_;
};

}  // namespace semblante::access
