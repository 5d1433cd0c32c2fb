#pragma once

#include <memory>

#include <boost/asio/awaitable.hpp>
#include <boost/beast/core/tcp_stream.hpp>

#include "server/net/state.h"

namespace semblante::net {

/// Sends a whole answer: header, then text, file in pieces, or a feed as chunks until it ends or the client goes.
/// `head_only` sends the header alone. False when the connection is not to be used again.
boost::asio::awaitable<bool> write_response(boost::beast::tcp_stream& stream, const http::Response& response,
                                            unsigned http_version, bool head_only, bool keep_alive,
                                            const SharedState& state);

/// Ends a connection so that the client can still read the answer although it was sending: closes our side, then reads
/// and drops what comes, for a little while.
boost::asio::awaitable<void> close_gently(boost::beast::tcp_stream& stream);

}  // namespace semblante::net
