#pragma once

// Private to net/.

#include <chrono>
#include <memory>
#include <string_view>

#include <boost/asio/any_io_executor.hpp>
#include <boost/asio/awaitable.hpp>
#include <boost/asio/buffer.hpp>
#include <boost/asio/ip/tcp.hpp>

#include "server/net/tls_session.h"

namespace semblante::net {

/// The bytes of one connection until it becomes a WebSocket: with TLS or without, each step with a deadline. A step
/// whose deadline passes ends with an error, and so do all later ones. On the strand of the socket only.
class Transport {
 public:
  using ErrorCode = boost::system::error_code;

  /// `tls` may be null: bytes are sent as they are.
  Transport(boost::asio::ip::tcp::socket socket, std::shared_ptr<TlsSession> tls);
  ~Transport();  // NOLINT(bugprone-exception-escape): see the definition
  Transport(const Transport&) = delete;
  Transport& operator=(const Transport&) = delete;

  [[nodiscard]] boost::asio::any_io_executor get_executor();
  [[nodiscard]] bool secure() const { return tls_ != nullptr; }

  /// Sets the deadline of the steps that follow, until it is set again.
  void expires_after(std::chrono::steady_clock::duration time);
  /// Does nothing without TLS.
  boost::asio::awaitable<ErrorCode> handshake();
  /// Reads at least one byte; the number of bytes.
  boost::asio::awaitable<std::size_t> read_some(boost::asio::mutable_buffer into, ErrorCode& error);
  /// Writes all bytes of both.
  boost::asio::awaitable<ErrorCode> write(std::string_view first, std::string_view second = {});
  /// Ends the sending direction, and reads and drops what the client still sends, so that it gets the last answer
  /// before its own unread bytes reset the connection.
  boost::asio::awaitable<void> close_gently();

  /// For a WebSocket: the socket, without a deadline. Nothing else may be called after it.
  [[nodiscard]] boost::asio::ip::tcp::socket release_socket();
  [[nodiscard]] const std::shared_ptr<TlsSession>& tls() const { return tls_; }

 private:
  struct Timed;
  class Limited;

  boost::asio::awaitable<ErrorCode> wait(TlsSession::Step step);

  std::shared_ptr<Timed> timed_;
  std::shared_ptr<TlsSession> tls_;
};

}  // namespace semblante::net
