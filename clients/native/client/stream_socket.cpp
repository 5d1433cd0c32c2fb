#include "clients/native/client/stream_socket.h"

#include <span>
#include <utility>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/websocket.hpp>

#include "clients/native/client/stream_refusal.h"
#include "protocol/cpp/messages.h"
#include "protocol/http/connection.h"

namespace semblante::client {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using boost::system::error_code;
using Clock = std::chrono::steady_clock;

}  // namespace

/// Everything runs inside run_until, on the caller's thread; a read stays pending between calls.
struct StreamSocket::Impl {
  asio::io_context io{1};
  websocket::stream<Connection, false> socket{io.get_executor()};  ///< no compression: it is not offered
  beast::flat_buffer buffer;
  std::string where;
  SocketOptions options;
  bool reading = false;
  std::optional<error_code> read_result;
  std::string fault;  ///< an exception that ended an operation and the connection

  /// Runs handlers until `done` or the deadline.
  template <class Done>
  bool run_until(Clock::time_point deadline, Done done) {
    // Ready handlers run even after the deadline, so that callers with a zero timeout make progress too; not without
    // end, since a server that sends nothing but pings or empty fragments always makes one ready.
    constexpr int most_after_deadline = 64;
    int after_deadline = 0;
    io.restart();
    while (!done() && fault.empty()) {
      try {
        if (io.run_one_until(deadline) == 0 && (++after_deadline > most_after_deadline || io.poll_one() == 0)) {
          break;
        }
      } catch (const std::exception& thrown) {
        fault = std::string("unexpected: ") + thrown.what();
        beast::get_lowest_layer(socket).close();
      }
    }
    return done();
  }

  /// Starts an operation and waits for its end. `start` gets a handler that takes an error_code (and more).
  template <class Start>
  Status wait(const char* step, Start start) {
    std::optional<error_code> result;
    start([&result](const error_code& problem, auto&&...) { result = problem; });
    if (!run_until(Clock::now() + options.timeout, [&] { return result.has_value(); })) {
      // The handler refers to this frame, so the operation must end with it.
      beast::get_lowest_layer(socket).cancel();
      run_until(Clock::now() + options.timeout, [&] { return result.has_value(); });
      return Error{ErrorCode::io, where, std::string(step) + ": " + (fault.empty() ? "no answer in time" : fault)};
    }
    if (*result) {
      return Error{ErrorCode::io, where, std::string(step) + ": " + result->message()};
    }
    return Unit{};
  }

  Status open(const ServerAddress& server, const std::string& target) {
    const Url& url = server.url;
    asio::ip::tcp::resolver resolver(io);
    asio::ip::tcp::resolver::results_type endpoints;
    std::optional<error_code> resolved;
    resolver.async_resolve(url.host, url.port, [&](const error_code& problem, auto results) {
      endpoints = std::move(results);
      resolved = problem;
    });
    if (!run_until(Clock::now() + options.timeout, [&] { return resolved.has_value(); }) || *resolved) {
      return Error{ErrorCode::io, where, "cannot find the host"};
    }
    auto connected = wait("cannot connect", [&](auto done) {
      beast::get_lowest_layer(socket).async_connect(endpoints, std::move(done));
    });
    if (!connected) {
      return connected;
    }
    error_code ignored;
    beast::get_lowest_layer(socket).socket().set_option(asio::ip::tcp::no_delay(true), ignored);
    auto& connection = socket.next_layer();
    if (auto ready = connection.secure(server); !ready) {
      return ready;
    }
    auto agreed_on = wait("cannot agree on TLS", [&](auto done) { connection.async_handshake(std::move(done)); });
    if (!agreed_on) {
      return connection.certificate_fault().empty() ? agreed_on : handshake_failed(connection, url, {});
    }
    const std::string_view protocol = options.json ? json_subprotocol : binary_subprotocol;
    socket.set_option(websocket::stream_base::decorator([protocol, &server](websocket::request_type& request) {
      request.set(http::field::sec_websocket_protocol, std::string(protocol));
      request.set(http::field::user_agent, "semblante-client");
      if (!server.token.empty()) request.set(http::field::authorization, "Bearer " + server.token);
    }));
    socket.read_message_max(options.json ? max_json_message_bytes : max_binary_message_bytes);
    websocket::response_type response;
    auto shaken = wait("the stream refuses the connection",
                       [&](auto done) { socket.async_handshake(response, url.authority(), target, std::move(done)); });
    if (!shaken) {
      if (auto refusal = stream_refusal(static_cast<int>(response.result_int()), response.body(), where))
        return *std::move(refusal);
      return shaken;
    }
    const auto agreed = response[http::field::sec_websocket_protocol];
    if (std::string_view(agreed.data(), agreed.size()) != protocol) {
      return no_such_subprotocol(protocol, where);
    }
    return Unit{};
  }
};

StreamSocket::StreamSocket(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
StreamSocket::~StreamSocket() = default;
StreamSocket::StreamSocket(StreamSocket&&) noexcept = default;
StreamSocket& StreamSocket::operator=(StreamSocket&&) noexcept = default;

Result<StreamSocket> StreamSocket::open(const ServerAddress& server, std::string_view stream,
                                        const SocketOptions& options) {
  auto impl = std::make_unique<Impl>();
  const Url& url = server.url;
  const std::string target = url.path + "/v1/streams/" + escape_segment(stream);
  impl->where = url.authority() + target;
  impl->options = options;
  if (auto opened = impl->open(server, target); !opened) {
    return std::move(opened).error();
  }
  return StreamSocket(std::move(impl));
}

Result<std::optional<std::span<const std::uint8_t>>> StreamSocket::read(std::chrono::milliseconds timeout) {
  using Bytes = std::optional<std::span<const std::uint8_t>>;
  Impl& impl = *impl_;
  if (!impl.reading) {
    impl.reading = true;
    impl.read_result.reset();
    impl.buffer.clear();
    impl.socket.async_read(impl.buffer,
                           [&impl](const error_code& problem, std::size_t) { impl.read_result = problem; });
  }
  const bool ended = impl.run_until(Clock::now() + timeout, [&] { return impl.read_result.has_value(); });
  if (!impl.fault.empty()) {
    return Error{ErrorCode::internal, impl.where, "the stream ended: " + impl.fault};
  }
  if (!ended) {
    return Bytes();
  }
  impl.reading = false;
  if (*impl.read_result) {
    const bool large = *impl.read_result == websocket::error::message_too_big;
    return Error{large ? ErrorCode::too_large : ErrorCode::io, impl.where,
                 "the stream ended: " + impl.read_result->message()};
  }
  const auto data = impl.buffer.cdata();
  return Bytes(std::span(static_cast<const std::uint8_t*>(data.data()), data.size()));
}

Status StreamSocket::send(std::span<const std::uint8_t> bytes) {
  Impl& impl = *impl_;
  impl.socket.text(impl.options.json);
  return impl.wait("cannot send", [&](auto done) {
    impl.socket.async_write(asio::buffer(bytes.data(), bytes.size()), std::move(done));
  });
}

void StreamSocket::close() {
  if (!impl_->socket.is_open()) {
    return;
  }
  // The result is ignored.
  static_cast<void>(impl_->wait(
      "cannot close", [&](auto done) { impl_->socket.async_close(websocket::close_code::normal, std::move(done)); }));
}

std::uint16_t StreamSocket::close_code() const { return impl_->socket.reason().code; }

std::string StreamSocket::close_reason() const {
  const auto& reason = impl_->socket.reason().reason;
  return {reason.data(), reason.size()};
}

}  // namespace semblante::client
