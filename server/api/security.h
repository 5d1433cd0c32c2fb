#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "server/access/client_limits.h"
#include "server/access/shares.h"
#include "server/access/tickets.h"
#include "server/access/token_limits.h"
#include "server/access/token_registry.h"
#include "server/http/address_range.h"

namespace semblante::api {

/// Who may use the server, and how much.
struct Security {
  bool asks_for_tokens = false;  ///< false: every request may do everything
  std::shared_ptr<access::TokenRegistry> tokens = std::make_shared<access::TokenRegistry>();
  std::shared_ptr<access::Tickets> tickets = std::make_shared<access::Tickets>();
  std::shared_ptr<access::ClientRates> rates = std::make_shared<access::ClientRates>(access::ClientLimits{});
  access::TokenLimits token_limits;
  std::shared_ptr<access::Shares> uploads = std::make_shared<access::Shares>();  ///< by token
  std::vector<http::AddressRange> proxies;                                       ///< whose X-Forwarded-* are believed
  std::optional<std::uint16_t> https_port;  ///< requests without TLS are redirected there
};

}  // namespace semblante::api
