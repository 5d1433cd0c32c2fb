#pragma once

#include <span>
#include <string>

#include "server/http/address_range.h"
#include "server/http/message.h"

namespace semblante::access {

/// Where a request comes from, seen through proxies.
struct Requester {
  std::string address;  ///< IP address of the client
  bool secure = false;  ///< the client's own connection has TLS
};

/// The other end of the connection; if that is one of `proxies`, the client that it names: the last address of
/// X-Forwarded-For that is no proxy itself, and X-Forwarded-Proto. Headers of others are ignored.
Requester requester_of(const http::Request& request, std::span<const http::AddressRange> proxies);

}  // namespace semblante::access
