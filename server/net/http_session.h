#pragma once

#include <memory>

#include <boost/asio/awaitable.hpp>
#include <boost/asio/ip/tcp.hpp>

#include "server/net/state.h"
#include "server/net/tls_session.h"

namespace semblante::net {

/// Serves one accepted connection to its end, or until it becomes a WebSocket; `tls`: after its handshake, or null. All
/// its state is local to this coroutine, on the strand of the socket; only the handler runs elsewhere (worker pool),
/// and the coroutine waits for it.
boost::asio::awaitable<void> serve_connection(boost::asio::ip::tcp::socket socket, std::shared_ptr<TlsSession> tls,
                                              std::shared_ptr<SharedState> state, ConnectionCount count);

}  // namespace semblante::net
