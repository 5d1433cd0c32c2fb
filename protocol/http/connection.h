#pragma once

// For http_send.cpp and clients/native/client/stream_socket.cpp: Boost stays within these.

#include <memory>
#include <optional>
#include <string>
#include <utility>

#include <boost/asio/async_result.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/ssl.hpp>
#include <boost/beast/core/stream_traits.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/websocket/teardown.hpp>

#include "protocol/http/server_address.h"

namespace semblante::client {

/// A connection to a server, with TLS or without: one type, so that what is built on it is compiled once.
class Connection {
 public:
  using error_code = boost::system::error_code;
  using next_layer_type = boost::beast::tcp_stream;
  using executor_type = next_layer_type::executor_type;

  explicit Connection(const executor_type& executor) : tcp_(executor) {}

  [[nodiscard]] executor_type get_executor() { return tcp_.get_executor(); }
  [[nodiscard]] next_layer_type& next_layer() { return tcp_; }
  [[nodiscard]] const next_layer_type& next_layer() const { return tcp_; }

  /// After the TCP connection: prepares TLS if the server has it. Errors: io (the authority's file cannot be read).
  Status secure(const ServerAddress& server) {
    if (!server.url.secure) return Unit{};
    namespace ssl = boost::asio::ssl;
    auto context = std::make_unique<ssl::context>(ssl::context::tls_client);
    error_code problem;
    context->set_options(ssl::context::default_workarounds | ssl::context::no_tlsv1 | ssl::context::no_tlsv1_1,
                         problem);
    if (!server.verify)
      context->set_verify_mode(ssl::verify_none, problem);
    else if (server.authority.empty())
      context->set_default_verify_paths(problem);
    else
      context->load_verify_file(server.authority.string(), problem);
    if (problem)
      return Error{ErrorCode::io, server.authority.string(), "the certificate of the authority: " + problem.message()};
    context_ = std::move(context);
    tls_.emplace(tcp_, *context_);
    if (server.verify) {
      tls_->set_verify_mode(ssl::verify_peer, problem);
      tls_->set_verify_callback(ssl::host_name_verification(server.url.host), problem);
    }
    if (!is_address(server.url.host)) SSL_set_tlsext_host_name(tls_->native_handle(), server.url.host.c_str());
    return Unit{};
  }
  [[nodiscard]] bool is_secure() const { return tls_.has_value(); }

  /// The handshake of TLS; completes at once without TLS.
  template <class Token>
  auto async_handshake(Token&& token) {
    return boost::asio::async_initiate<Token, void(error_code)>(
        [this](auto handler) {
          if (tls_)
            tls_->async_handshake(boost::asio::ssl::stream_base::client, std::move(handler));
          else
            boost::asio::post(get_executor(), [handler = std::move(handler)]() mutable { handler(error_code{}); });
        },
        token);
  }
  /// What is wrong with the certificate of a handshake that failed; empty: nothing.
  [[nodiscard]] std::string certificate_fault() {
    if (!tls_) return {};
    const auto result = SSL_get_verify_result(tls_->native_handle());
    return result == X509_V_OK ? std::string() : X509_verify_cert_error_string(result);
  }

  template <class Buffers, class Token>
  auto async_read_some(const Buffers& buffers, Token&& token) {
    return boost::asio::async_initiate<Token, void(error_code, std::size_t)>(
        [this](auto handler, const Buffers& into) {
          if (tls_)
            tls_->async_read_some(into, std::move(handler));
          else
            tcp_.async_read_some(into, std::move(handler));
        },
        token, buffers);
  }
  template <class Buffers, class Token>
  auto async_write_some(const Buffers& buffers, Token&& token) {
    return boost::asio::async_initiate<Token, void(error_code, std::size_t)>(
        [this](auto handler, const Buffers& from) {
          if (tls_)
            tls_->async_write_some(from, std::move(handler));
          else
            tcp_.async_write_some(from, std::move(handler));
        },
        token, buffers);
  }

 private:
  static bool is_address(const std::string& host) {
    error_code problem;
    boost::asio::ip::make_address(host, problem);
    return !problem;
  }

  boost::beast::tcp_stream tcp_;
  std::unique_ptr<boost::asio::ssl::context> context_;
  std::optional<boost::asio::ssl::stream<boost::beast::tcp_stream&>> tls_;
};

/// The error of a handshake that failed.
inline Error handshake_failed(Connection& connection, const Url& url, const boost::system::error_code& problem) {
  const auto fault = connection.certificate_fault();
  return {ErrorCode::io, url.authority(),
          fault.empty() ? "cannot agree on TLS: " + problem.message()
                        : "the certificate is not trusted: " + fault + " (--ca FILE names another authority)"};
}

// Found by Beast for the end of a WebSocket. The closing handshake has been made, so the socket is simply closed.
inline void teardown(boost::beast::role_type role, Connection& connection, boost::system::error_code& problem) {
  teardown(role, connection.next_layer(), problem);  // that of tcp_stream
}
template <class Handler>
void async_teardown(boost::beast::role_type role, Connection& connection, Handler&& handler) {
  async_teardown(role, connection.next_layer(), std::forward<Handler>(handler));
}

}  // namespace semblante::client
