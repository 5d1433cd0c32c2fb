#pragma once

#include <boost/asio/redirect_error.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <boost/system/error_code.hpp>

namespace semblante::net {

/// Completion token of `co_await`: stores the operation's error in `error` instead of throwing it. Available since
/// Boost 1.74; asio::as_tuple needs 1.79.
inline auto error_into(boost::system::error_code& error) {
  return boost::asio::redirect_error(boost::asio::use_awaitable, error);
}

}  // namespace semblante::net
