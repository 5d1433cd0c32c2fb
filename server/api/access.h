#pragma once

#include <optional>
#include <string>
#include <vector>

#include "server/http/message.h"
#include "server/http/problem.h"

namespace semblante::api {

/// Who may use the server, by what a browser says of itself. The server listens on loopback and asks nobody who they
/// are, so what remains to be kept out is the page of somebody else that a browser of this machine shows.
struct Access {
  /// Names the server goes by beside localhost and the loopback addresses, without port; "*": any. A page whose own
  /// name was made to point to this machine (DNS rebinding) counts as the same origin to its browser; its Host is
  /// still the foreign name.
  std::vector<std::string> hosts;
  /// Origins whose pages may change things and read answers, beside pages from this machine; "*": all.
  std::vector<std::string> origins;

  /// Why a request for reading only is refused; nullopt when it is not.
  [[nodiscard]] std::optional<http::Problem> refuse_reading(const http::Request& head) const;
  /// The same for a request that may change something or opens a stream.
  [[nodiscard]] std::optional<http::Problem> refuse_changing(const http::Request& head) const;
  /// True without an Origin: programs that are no browsers send none.
  [[nodiscard]] bool origin_allowed(const http::Request& head) const;
};

}  // namespace semblante::api
