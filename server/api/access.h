#pragma once

#include <optional>
#include <string>
#include <vector>

#include "server/http/message.h"
#include "server/http/problem.h"

namespace semblante::api {

/// Access control by the Host and Origin headers of a request. The server listens on loopback and has no
/// authentication, so the remaining danger is a foreign page in a browser on this machine.
struct Access {
  /// Host names accepted besides localhost and the loopback addresses, without port; "*": any. With DNS rebinding a
  /// foreign page has the same origin as this server for its browser, but its Host is still the foreign name.
  std::vector<std::string> hosts;
  /// Origins whose pages may make changes and read answers, besides pages of this machine; "*": all.
  std::vector<std::string> origins;

  /// The problem with which a read-only request is refused; nullopt when it is allowed.
  [[nodiscard]] std::optional<http::Problem> refuse_reading(const http::Request& head) const;
  /// The same for a request that may make changes or opens a stream.
  [[nodiscard]] std::optional<http::Problem> refuse_changing(const http::Request& head) const;
  /// True without an Origin: only browsers send one.
  [[nodiscard]] bool origin_allowed(const http::Request& head) const;
};

}  // namespace semblante::api
