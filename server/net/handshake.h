#pragma once

// Private to net/.

#include <memory>

#include <boost/asio/awaitable.hpp>
#include <boost/asio/ip/tcp.hpp>

#include "server/net/state.h"
#include "server/net/tls_context.h"

namespace semblante::net {

/// The handshake of TLS of one accepted connection, on the strand of its socket; after it, the connection is served on
/// a strand of `io`.
boost::asio::awaitable<void> shake_hands(boost::asio::ip::tcp::socket socket, std::shared_ptr<const TlsContext> context,
                                         std::shared_ptr<SharedState> state, ConnectionCount count);

}  // namespace semblante::net
