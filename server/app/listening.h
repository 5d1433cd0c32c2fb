#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "server/http/address_range.h"
#include "server/net/server.h"

namespace semblante {

/// Where and for whom `serve` listens, as given by options.
struct ListenOptions {
  std::string address = "127.0.0.1";  ///< with `port`: the one listener, unless `listen` has some
  std::uint16_t port = 8080;
  std::vector<std::string> listen;     ///< "0.0.0.0:443", "[::]:443"; with TLS if there is a certificate
  std::vector<std::string> redirects;  ///< places without TLS whose requests are redirected to the first of `listen`
  std::filesystem::path certificate, key;
  std::vector<std::string> proxies;  ///< addresses or ranges
  bool require_tokens = false;
};

/// The same, checked.
struct Listening {
  std::vector<net::Listener> listeners;  ///< those for https before those that redirect
  std::vector<http::AddressRange> proxies;
  bool tls = false;
  bool is_public = false;  ///< a listener can be reached from other machines, or by a proxy
  bool asks_for_tokens = false;
};

/// Throws CommandFailure for a place or a range that cannot be read, for a certificate without its key, and for a
/// public listener without TLS: the message has the lines that mend it. `data` is only for that message.
Listening check_listening(const ListenOptions& options, const std::filesystem::path& data);

/// "http://127.0.0.1:8080". The port is that of the bound socket.
std::string url_of(const net::Listener& listener, std::uint16_t port);

}  // namespace semblante
