#pragma once

#include <memory>

#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/message.hpp>

#include "server/net/state.h"

namespace semblante::net {

/// Answers the upgrade and runs the WebSocket to its end, by callbacks on the strand of the socket. Returns at once:
/// the HTTP session that led here ends, so that its buffers do not stay behind a connection that is idle for hours.
void serve_websocket(boost::asio::ip::tcp::socket socket,
                     boost::beast::http::request<boost::beast::http::empty_body> upgrade,
                     std::shared_ptr<http::WebSocketPeer> peer, std::shared_ptr<SharedState> state,
                     ConnectionCount connection);

}  // namespace semblante::net
