#pragma once

#include <memory>

#include <boost/asio/awaitable.hpp>
#include <boost/beast/core/tcp_stream.hpp>

#include "server/net/state.h"

namespace semblante::net {

/// Sends an answer: header, then text, a file in pieces, or a feed as chunks until it ends or the client disconnects.
/// `head_only` sends only the header. False when the connection must not be used again.
boost::asio::awaitable<bool> write_response(boost::beast::tcp_stream& stream, const http::Response& response,
                                            unsigned http_version, bool head_only, bool keep_alive,
                                            const SharedState& state);

/// Ends a connection so that a client that is still sending can read the answer: shuts down the sending side, then
/// reads and discards input for a short time.
boost::asio::awaitable<void> close_gently(boost::beast::tcp_stream& stream);

}  // namespace semblante::net
