#include "server/access/client_limits.h"

#include <cmath>

namespace semblante::access {
namespace {

/// Number of clients at which idle ones are looked for; again after as many more requests of new clients.
constexpr std::size_t many_clients = 1024;
constexpr double seconds_per_minute = 60.0;

}  // namespace

void ClientRates::forget_idle(Rates& rates, Clock::time_point now) {
  if (rates.size() < many_clients || rates.size() % many_clients != 0) return;
  std::erase_if(rates, [now](const auto& item) { return item.second.is_full(now); });
}

bool ClientRates::take_request(const std::string& client, Clock::time_point now) {
  if (limits_.requests_per_second <= 0) return true;
  const std::lock_guard lock(mutex_);
  forget_idle(requests_, now);
  return requests_.try_emplace(client, limits_.requests_per_second, limits_.request_burst, now)
      .first->second.take(1.0, now);
}

bool ClientRates::may_try(const std::string& address, Clock::time_point now) {
  const std::lock_guard lock(mutex_);
  const auto found = failures_.find(address);
  return found == failures_.end() || found->second.has(1.0, now);
}

void ClientRates::count_failure(const std::string& address, Clock::time_point now) {
  const std::lock_guard lock(mutex_);
  forget_idle(failures_, now);
  failures_.try_emplace(address, limits_.failures_per_minute / seconds_per_minute, limits_.failures_per_minute, now)
      .first->second.take(1.0, now);
}

bool ClientRates::take_creation(const std::string& address, Clock::time_point now) {
  const double most = limits_.creations_per_minute;
  if (most <= 0) return true;
  const std::lock_guard lock(mutex_);
  forget_idle(creations_, now);
  return creations_.try_emplace(address, most / seconds_per_minute, most, now).first->second.take(1.0, now);
}

unsigned ClientRates::seconds_per_creation() const {
  return static_cast<unsigned>(std::ceil(seconds_per_minute / limits_.creations_per_minute));
}

std::size_t ClientRates::size() const {
  const std::lock_guard lock(mutex_);
  return requests_.size() + failures_.size() + creations_.size();
}

}  // namespace semblante::access
