#pragma once

#include <string>
#include <string_view>

namespace semblante::client {

/// Sec-WebSocket-Accept for a Sec-WebSocket-Key (RFC 6455, section 4.2.2): what shows that the other side speaks
/// WebSocket.
std::string web_socket_accept(std::string_view key);

}  // namespace semblante::client
