#pragma once

#include <boost/asio/redirect_error.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <boost/system/error_code.hpp>

namespace semblante::net {

/// Completion token of `co_await`: the operation's error goes into `error` instead of being thrown. Every Boost from
/// 1.74 on has it; asio::as_tuple came with 1.79.
inline auto error_into(boost::system::error_code& error) {
  return boost::asio::redirect_error(boost::asio::use_awaitable, error);
}

}  // namespace semblante::net
