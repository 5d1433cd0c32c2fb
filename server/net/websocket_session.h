#pragma once

#include <memory>

#include <boost/asio/awaitable.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/message.hpp>

#include "server/net/state.h"

namespace semblante::net {

/// Answers the upgrade and runs the WebSocket to its end: one coroutine reads, one writes what the peer has to say,
/// both on the strand of the socket.
boost::asio::awaitable<void> serve_websocket(boost::beast::tcp_stream stream,
                                             boost::beast::http::request<boost::beast::http::empty_body> upgrade,
                                             std::shared_ptr<http::WebSocketPeer> peer,
                                             std::shared_ptr<SharedState> state);

}  // namespace semblante::net
