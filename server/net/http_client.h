#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "core/types/result.h"

namespace semblante::net {

/// Where a server is: "http://127.0.0.1:8080", nothing after it but a slash.
struct ServerAddress {
  std::string host, port;
};
Result<ServerAddress> parse_server_address(std::string_view url);

struct ClientRequest {
  std::string method = "GET", target, content_type, body;
};
struct ClientResponse {
  int status = 0;
  std::string location, body;  ///< location: the header's, may be empty
};

/// Asks a server one thing, on a connection of its own, and waits for the answer (at most 30 s, 64 MiB). For the
/// command line; the server itself asks nobody. Errors: io, with what went wrong in words.
Result<ClientResponse> ask(const ServerAddress& server, const ClientRequest& request);

}  // namespace semblante::net
