#include "server/net/http_session.h"

#include <algorithm>
#include <cctype>
#include <optional>
#include <string>
#include <utility>

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http/error.hpp>

#include "core/types/letter_case.h"
#include "server/http/media_type.h"
#include "server/http/problem.h"
#include "server/http/request_id.h"
#include "server/log/guard.h"
#include "server/log/log.h"
#include "server/net/body_sink.h"
#include "server/net/error_value.h"
#include "server/net/request_parser.h"
#include "server/net/response_writer.h"
#include "server/net/transport.h"
#include "server/net/websocket_session.h"

namespace semblante::net {

namespace asio = boost::asio;
namespace beast = boost::beast;

namespace {

using boost::system::error_code;

/// Maximum bytes of one read.
constexpr std::size_t piece_bytes = std::size_t{16} * 1024;

/// The client's address without its port; one that was mapped from IPv4 is written as IPv4.
std::string address_of(const asio::ip::tcp::socket& socket) {
  error_code error;
  const auto end = socket.remote_endpoint(error);
  if (error) return {};
  const auto address = end.address();
  if (address.is_v6() && address.to_v6().is_v4_mapped())
    return asio::ip::make_address_v4(asio::ip::v4_mapped, address.to_v6()).to_string();
  return address.to_string();
}

/// The result of `ask`, or a 500 when it throws: an internal error ends only its own request.
template <class Ask>
auto answered(const http::Request& request, Ask ask) -> decltype(ask()) {
  const log::Scope scope({.request = request.id});
  try {
    return ask();
  } catch (...) {
    log::caught(request.method + " " + request.path);
    return http::to_response(http::make_problem("internal", "the request could not be served"));
  }
}

/// Whether this is a request for a WebSocket (RFC 6455 section 4.2.1); other protocols of an Upgrade are ignored.
bool is_websocket_upgrade(const RequestParser& parser, const http::Request& request) {
  if (parser.version() != 11 || request.method != "GET" || !parser.upgrade()) return false;
  const auto protocols = http::split_list(request.header("Upgrade").value_or(""));
  return std::any_of(protocols.begin(), protocols.end(),
                     [](const auto& name) { return equal_ignoring_case(name, "websocket"); });
}

/// 16 bytes in base64.
bool is_websocket_key(std::string_view key) {
  constexpr std::size_t digits = 22;
  const auto is_digit = [](unsigned char c) { return std::isalnum(c) != 0 || c == '+' || c == '/'; };
  return key.size() == digits + 2 && key.substr(digits) == "==" &&
         std::all_of(key.begin(), key.begin() + digits, is_digit);
}

/// The state of one connection; a local object of its coroutine.
class Session {
 public:
  Session(asio::ip::tcp::socket socket, std::shared_ptr<TlsSession> tls, std::shared_ptr<SharedState> state,
          ConnectionCount count)
      : peer_address_(address_of(socket)),
        transport_(std::move(socket), std::move(tls)),
        state_(std::move(state)),
        count_(std::move(count)),
        buffer_(state_->config.limits.max_header_bytes) {}

  asio::awaitable<void> run() {
    while (!state_->stopping) {
      const auto next = co_await serve_one();
      if (next == Next::again) continue;
      if (next == Next::close) co_await transport_.close_gently();
      co_return;
    }
  }

 private:
  enum class Next { again, close, gone };

  /// Counts a connection with a pending answer: a shutdown waits only for those, and for WebSockets.
  class Busy {
   public:
    explicit Busy(SharedState& state) : state_(state) { ++state_.busy; }
    ~Busy() { --state_.busy; }
    Busy(const Busy&) = delete;
    Busy& operator=(const Busy&) = delete;

   private:
    SharedState& state_;
  };

  asio::awaitable<Next> answer(const http::Request& request, http::Response response, unsigned version, bool keep) {
    {
      const log::Scope scope({.request = request.id});
      state_->application.decorate(request, response);
      response.headers[std::string(http::request_id_header)] = request.id;
      http::add_request_id(response, request.id);
      if (log::enabled(log::Level::debug))
        log::debug(request.method + " " + request.path + " " + std::to_string(response.status));
    }
    const bool keep_alive = keep && !state_->stopping;
    const bool usable =
        co_await write_response(transport_, response, version, request.method == "HEAD", keep_alive, *state_);
    co_return usable ? Next::again : Next::close;
  }

  asio::awaitable<Next> serve_one() {
    const auto& limits = state_->config.limits;
    // The wait for a request may be long; once it has begun, its header has a short deadline.
    for (bool is_first = true; is_first || buffer_.size() == 0; is_first = false) {
      if (buffer_.size() == 0) {
        transport_.expires_after(limits.idle_timeout);
        if (co_await fill()) co_return Next::gone;
      }
      if (is_first && co_await skip_empty_line()) co_return Next::gone;
    }
    RequestParser parser(limits.max_header_bytes, limits.max_header_fields);
    transport_.expires_after(limits.header_timeout);
    while (!parser.is_header_done())
      if (const auto error = co_await step(parser)) co_return co_await refuse(parser, error);
    ++state_->requests_total;
    const Busy busy(*state_);

    auto& request = parser.request();
    request.id = http::new_request_id();
    request.peer = peer_address_;
    request.secure = transport_.secure();
    state_->application.find_route(request);
    if (is_websocket_upgrade(parser, request)) co_return co_await upgrade(request);

    auto plan = answered(request, [&] { return state_->application.plan(request); });
    if (auto* refusal = std::get_if<http::Response>(&plan)) {
      // The body has not arrived: the connection is reusable only if the request has none.
      const bool keep = parser.is_done() && parser.keep_alive();
      co_return co_await answer(request, std::move(*refusal), parser.version(), keep);
    }
    const auto& body = std::get<http::BodyPlan>(plan);
    if (const auto unread = co_await read_body(parser, body)) {
      if (unread->gone()) co_return Next::gone;
      co_return co_await answer(request, http::to_response(*unread->problem), parser.version(), false);
    }
    const auto handle = [this, &request] {
      return answered(request, [&] { return state_->application.handle(request); });
    };
    http::Response response;
    if (body.immediate)
      response = handle();
    else
      response = co_await asio::co_spawn(
          state_->workers.executor(), [&handle]() -> asio::awaitable<http::Response> { co_return handle(); },
          asio::use_awaitable);
    co_return co_await answer(request, std::move(response), parser.version(), parser.keep_alive());
  }

  /// Reads at least one byte and appends it to the buffer. The buffer's size bounds the unparsed bytes of a connection.
  asio::awaitable<error_code> fill() {
    const auto room = buffer_.max_size() - buffer_.size();
    if (room == 0) co_return beast::http::error::buffer_overflow;
    error_code error;
    const std::size_t count = co_await transport_.read_some(buffer_.prepare(std::min(room, piece_bytes)), error);
    buffer_.commit(count);
    co_return error;
  }

  /// An empty line before a request is ignored (RFC 9112, 2.2): some clients send one behind a body.
  asio::awaitable<error_code> skip_empty_line() {
    const auto byte = [this](std::size_t i) { return static_cast<const char*>(buffer_.cdata().data())[i]; };
    if (byte(0) != '\r') co_return error_code{};
    transport_.expires_after(state_->config.limits.header_timeout);
    while (buffer_.size() < 2)
      if (const auto error = co_await fill()) co_return error;
    if (byte(1) == '\n') buffer_.consume(2);
    co_return error_code{};
  }

  /// Parses up to the next piece of the message, or reads more. Beast's own read functions parse inside the I/O loop,
  /// where an exception would end the loop and not this coroutine.
  asio::awaitable<error_code> step(RequestParser& parser) {
    error_code error = beast::http::error::need_more;
    if (buffer_.size() >= parser.least_bytes()) buffer_.consume(parser.take(buffer_.data(), error));
    if (error == beast::http::error::need_more) error = co_await fill();
    co_return error;
  }

  [[nodiscard]] std::optional<http::Problem> problem_of(const RequestParser& parser, const error_code& error) const {
    const auto unread = buffer_.cdata();
    return parser.problem_of(error, {static_cast<const char*>(unread.data()), unread.size()});
  }

  asio::awaitable<Next> refuse(RequestParser& parser, const error_code& error) {
    const auto problem = problem_of(parser, error);
    if (!problem) co_return Next::gone;
    http::Request unknown;
    unknown.id = http::new_request_id();
    unknown.method = parser.request().method == "HEAD" ? "HEAD" : "GET";  // which decides whether a body is sent
    for (const char* const name : {"Host", "Origin"})                     // they decide which pages may read the answer
      if (const auto value = parser.request().header(name)) unknown.headers.emplace(name, *value);
    co_return co_await answer(unknown, http::to_response(*problem), 11, false);
  }

  /// The reason why a body was not read completely.
  struct Unread {
    std::optional<http::Problem> problem;  ///< nullopt: the client has disconnected
    [[nodiscard]] bool gone() const { return !problem; }
  };

  /// nullopt when the body is complete.
  asio::awaitable<std::optional<Unread>> read_body(RequestParser& parser, const http::BodyPlan& plan) {
    auto& request = parser.request();
    const auto length = parser.content_length();
    if (length && *length > plan.max_bytes) co_return Unread{BodySink::too_large(plan)};
    if (plan.required && !length && !parser.chunked())
      co_return Unread{http::make_problem("length-required", "the request has neither Content-Length nor chunks")};
    if (const auto expect = request.header("Expect")) {
      if (!equal_ignoring_case(*expect, "100-continue"))
        co_return Unread{http::make_problem("expectation-failed", "only Expect: 100-continue is supported")};
      transport_.expires_after(state_->config.limits.write_timeout);
      constexpr std::string_view go_on = "HTTP/1.1 100 Continue\r\n\r\n";
      // A client of HTTP/1.0 would take it for the answer (RFC 9110, 10.1.1).
      if (parser.version() == 11 && co_await transport_.write(go_on)) co_return Unread{};
    }
    BodySink sink(plan, *state_, request);
    parser.set_sink(sink);
    const auto& limits = state_->config.limits;
    const auto begin = std::chrono::steady_clock::now();
    while (!parser.is_done()) {
      // Each piece has its deadline, and all together a least rate: a body of many small pieces would hold its
      // connection and its file for days.
      const auto left = limits.body_time_left(begin, request.body_size);
      transport_.expires_after(std::min<std::chrono::steady_clock::duration>(limits.read_timeout, left));
      if (const auto error = co_await step(parser)) co_return Unread{problem_of(parser, error)};
    }
    co_return std::nullopt;
  }

  /// Checks for faults that Beast would answer in plain text.
  static std::optional<http::Response> handshake_fault(const http::Request& request) {
    if (request.header("Sec-WebSocket-Version").value_or("") != "13") {
      auto response = http::to_response(
          http::make_problem("upgrade-required", "Sec-WebSocket-Version must be 13, the only supported one"));
      response.headers["Sec-WebSocket-Version"] = "13";
      return response;
    }
    if (!is_websocket_key(request.header("Sec-WebSocket-Key").value_or("")))
      return http::to_response(http::make_problem("malformed-request", "Sec-WebSocket-Key must be 16 bytes in base64"));
    return std::nullopt;
  }

  asio::awaitable<Next> upgrade(const http::Request& request) {
    if (auto fault = handshake_fault(request)) co_return co_await answer(request, std::move(*fault), 11, false);
    if (buffer_.size() != 0)
      co_return co_await answer(
          request, http::to_response(http::make_problem("malformed-request", "bytes follow the upgrade request")), 11,
          false);
    // Opened last: a peer counts in its stream until it is told that its connection is closed.
    auto opened = answered(request, [&] { return state_->application.open_websocket(request); });
    if (auto* refusal = std::get_if<http::Response>(&opened))
      co_return co_await answer(request, std::move(*refusal), 11, false);
    auto tls = transport_.tls();
    serve_websocket(transport_.release_socket(), std::move(tls), *request.header("Sec-WebSocket-Key"), request.id,
                    std::move(std::get<std::shared_ptr<http::WebSocketPeer>>(opened)), state_, std::move(count_));
    co_return Next::gone;
  }

  const std::string peer_address_;
  Transport transport_;
  std::shared_ptr<SharedState> state_;
  ConnectionCount count_;
  beast::flat_buffer buffer_;
};

}  // namespace

asio::awaitable<void> serve_connection(asio::ip::tcp::socket socket, std::shared_ptr<TlsSession> tls,
                                       std::shared_ptr<SharedState> state, ConnectionCount count) {
  // Sends small answers and stream frames without delay.
  boost::system::error_code ignored;
  socket.set_option(asio::ip::tcp::no_delay(true), ignored);
  Session session(std::move(socket), std::move(tls), std::move(state), std::move(count));
  co_await session.run();
}

}  // namespace semblante::net
