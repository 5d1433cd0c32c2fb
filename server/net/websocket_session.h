#pragma once

#include <memory>
#include <string_view>

#include <boost/asio/ip/tcp.hpp>

#include "server/net/state.h"
#include "server/net/tls_session.h"

namespace semblante::net {

/// Answers the upgrade that came with this Sec-WebSocket-Key (24 characters), with the id of its request, and runs the
/// WebSocket to its end, by callbacks on a strand of `state->live`. Returns immediately: the HTTP session ends, so that
/// its buffers are not kept for a connection that is idle for hours. `tls` may be null.
void serve_websocket(boost::asio::ip::tcp::socket socket, std::shared_ptr<TlsSession> tls, std::string_view key,
                     std::string_view request_id, std::shared_ptr<http::WebSocketPeer> peer,
                     std::shared_ptr<SharedState> state, ConnectionCount connection);

}  // namespace semblante::net
