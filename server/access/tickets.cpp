#include "server/access/tickets.h"

#include <utility>

#include "server/access/secret.h"

namespace semblante::access {

void Tickets::forget_old(Clock::time_point now) {
  std::erase_if(tickets_, [now](const auto& item) { return item.second.ends <= now; });
}

std::optional<std::string> Tickets::issue(const Rights& rights, std::string path, Clock::time_point now) {
  auto ticket = random_secret();
  const std::lock_guard lock(mutex_);
  if (tickets_.size() >= most) forget_old(now);
  if (tickets_.size() >= most) return std::nullopt;
  tickets_.emplace(ticket, Ticket{rights, std::move(path), now + lifetime});
  return ticket;
}

std::optional<Rights> Tickets::redeem(std::string_view ticket, std::string_view path, Clock::time_point now) {
  const std::lock_guard lock(mutex_);
  // A look-up by a map may tell by its time how many first characters are right: the ticket has 256 random bits and
  // ends in 30 s, too short to use that.
  const auto found = tickets_.find(ticket);
  if (found == tickets_.end()) return std::nullopt;
  const auto used = std::move(found->second);
  tickets_.erase(found);
  if (used.path != path || used.ends <= now) return std::nullopt;
  return used.rights;
}

}  // namespace semblante::access
