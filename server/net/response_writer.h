#pragma once

#include <boost/asio/awaitable.hpp>

#include "server/net/state.h"
#include "server/net/transport.h"

namespace semblante::net {

/// Sends an answer: header, then text, a file in pieces, or a feed as chunks until it ends or the client disconnects.
/// `head_only` sends only the header. A file that cannot be opened is answered 503 instead. False when the connection
/// must not be used again.
boost::asio::awaitable<bool> write_response(Transport& transport, const http::Response& response, unsigned http_version,
                                            bool head_only, bool keep_alive, SharedState& state);

}  // namespace semblante::net
