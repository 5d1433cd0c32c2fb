#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

#include "core/types/token_bucket.h"

namespace semblante::access {

/// Limits of one client: of a token, or of an address without one.
struct ClientLimits {
  double requests_per_second = 50, request_burst = 500;  ///< 0: no limit
  double failures_per_minute = 30;                       ///< requests with a token that is not accepted, of one address
  double creations_per_minute = 120;                     ///< of one address, whatever is created; 0: no limit
};

/// Counts requests by client. Any thread. Clients that are idle are forgotten, so memory is bounded by the requests of
/// the last minute.
class ClientRates {
 public:
  using Clock = TokenBucket::Clock;
  explicit ClientRates(ClientLimits limits) : limits_(limits) {}

  /// False when this client has used up its requests.
  bool take_request(const std::string& client, Clock::time_point now = Clock::now());
  /// False when this address has sent too many tokens that were not accepted.
  bool may_try(const std::string& address, Clock::time_point now = Clock::now());
  void count_failure(const std::string& address, Clock::time_point now = Clock::now());
  /// False when this address has created as much as it may for now.
  bool take_creation(const std::string& address, Clock::time_point now = Clock::now());
  /// Seconds after which an address may create one thing more.
  [[nodiscard]] unsigned seconds_per_creation() const;
  /// Number of clients in memory.
  [[nodiscard]] std::size_t size() const;

 private:
  using Rates = std::map<std::string, TokenBucket, std::less<>>;
  void forget_idle(Rates& rates, Clock::time_point now);

  const ClientLimits limits_;
  mutable std::mutex mutex_;
  Rates requests_;
  Rates failures_;
  Rates creations_;
};

}  // namespace semblante::access
