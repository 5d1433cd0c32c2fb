#include "server/net/http_session.h"

#include <fcntl.h>
#include <optional>
#include <unistd.h>
#include <utility>

#include <boost/asio/as_tuple.hpp>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http/buffer_body.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/websocket/rfc6455.hpp>

#include "server/http/problem.h"
#include "server/http/url.h"
#include "server/log/log.h"
#include "server/net/response_writer.h"
#include "server/net/websocket_session.h"

namespace semblante::net {

namespace asio = boost::asio;
namespace beast = boost::beast;

namespace {

constexpr auto use_tuple = asio::as_tuple(asio::use_awaitable);
constexpr std::size_t piece_bytes = 64 * 1024;

using Parser = beast::http::request_parser<beast::http::buffer_body>;

std::string_view view(boost::core::string_view text) { return {text.data(), text.size()}; }

/// The header as plain values; nullopt when the target is not a path.
std::optional<http::Request> plain_request(const Parser::value_type& message) {
  http::Request request;
  request.method = std::string(view(message.method_string()));
  const auto target = http::parse_target(view(message.target()));
  if (!target) return std::nullopt;
  request.path = target->path;
  request.query = target->query;
  for (const auto& field : message) {
    const auto value = view(field.value());
    const auto [at, is_new] = request.headers.try_emplace(std::string(view(field.name_string())), value);
    if (!is_new) at->second.append(", ").append(value);
  }
  return request;
}

/// Where a body goes while it arrives: memory or a file of its own.
class BodySink {
 public:
  BodySink(const http::BodyPlan& plan, SharedState& state, http::Request& request)
      : plan_(plan), request_(request), application_(state.application) {
    if (!plan.to_file) return;
    const auto name = "upload-" + std::to_string(::getpid()) + "-" + std::to_string(state.upload_number++);
    request.body_file = std::make_shared<http::TemporaryFile>(state.config.upload_directory / name);
    descriptor_ = ::open(request.body_file->path().c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
    if (descriptor_ < 0) open_error_ = errno;
  }
  ~BodySink() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  BodySink(const BodySink&) = delete;
  BodySink& operator=(const BodySink&) = delete;

  /// The problem, if this piece cannot be taken.
  std::optional<http::Problem> append(std::string_view piece) {
    request_.body_size += piece.size();
    if (request_.body_size > plan_.max_bytes) return too_large(plan_);
    if (!plan_.to_file) {
      request_.body.append(piece);
      return std::nullopt;
    }
    while (!piece.empty()) {
      const auto written = descriptor_ < 0 ? -1 : ::write(descriptor_, piece.data(), piece.size());
      if (written < 0 && descriptor_ >= 0 && errno == EINTR) continue;
      if (written <= 0) return application_.unwritten_body(descriptor_ < 0 ? open_error_ : errno);
      piece.remove_prefix(static_cast<std::size_t>(written));
    }
    return std::nullopt;
  }

  static http::Problem too_large(const http::BodyPlan& plan) {
    return http::make_problem("content-too-large",
                              "at most " + std::to_string(plan.max_bytes) + " bytes are taken here");
  }

 private:
  const http::BodyPlan& plan_;
  http::Request& request_;
  http::Application& application_;
  int descriptor_ = -1, open_error_ = 0;
};

/// One connection's state between its coroutine's steps; lives in that coroutine.
class Session {
 public:
  Session(asio::ip::tcp::socket socket, std::shared_ptr<SharedState> state, ConnectionCount count)
      : stream_(std::move(socket)), state_(std::move(state)), count_(std::move(count)) {}

  asio::awaitable<void> run() {
    while (!state_->stopping) {
      const auto next = co_await serve_one();
      if (next == Next::again) continue;
      if (next == Next::close) co_await close_gently(stream_);
      co_return;
    }
  }

 private:
  enum class Next { again, close, gone };

  /// Counts a connection that is owed an answer: a stopping server waits for those, and for WebSockets, alone.
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
    state_->application.decorate(request, response);
    if (log::enabled(log::Level::debug))
      log::debug(request.method + " " + request.path + " " + std::to_string(response.status));
    const bool keep_alive = keep && !state_->stopping;
    const bool usable =
        co_await write_response(stream_, response, version, request.method == "HEAD", keep_alive, *state_);
    co_return usable ? Next::again : Next::close;
  }

  asio::awaitable<Next> serve_one() {
    const auto& limits = state_->config.limits;
    // Waiting for a request may be long; once it has begun, its header must come at once.
    if (buffer_.size() == 0) {
      stream_.expires_after(limits.idle_timeout);
      const auto [error, count] = co_await stream_.async_read_some(buffer_.prepare(piece_bytes / 8), use_tuple);
      if (error) co_return Next::gone;
      buffer_.commit(count);
    }
    Parser parser;
    parser.header_limit(limits.max_header_bytes);
    parser.body_limit(boost::none);  // counted by BodySink
    stream_.expires_after(limits.header_timeout);
    const auto [error, count] = co_await beast::http::async_read_header(stream_, buffer_, parser, use_tuple);
    if (error) co_return co_await refuse_header(error);
    ++state_->requests_total;
    const Busy busy(*state_);

    const auto& message = parser.get();
    const unsigned version = message.version();
    auto request = plain_request(message);
    if (!request || (version != 10 && version != 11)) {
      http::Request unknown;
      unknown.method = "GET";
      const auto problem = request ? http::make_problem("http-version", "the request speaks another version")
                                   : http::make_problem("malformed-request", "the request target is not a path");
      co_return co_await answer(unknown, http::to_response(problem), 11, false);
    }
    if (beast::websocket::is_upgrade(message)) co_return co_await upgrade(parser, *request);

    auto plan = state_->application.plan(*request);
    if (auto* refusal = std::get_if<http::Response>(&plan)) {
      // The body is still to come: only a request without one leaves the connection usable.
      const bool bodiless = parser.is_done();
      co_return co_await answer(*request, std::move(*refusal), version, bodiless && message.keep_alive());
    }
    if (auto problem = co_await read_body(parser, std::get<http::BodyPlan>(plan), *request)) {
      if (problem->slug.empty()) co_return Next::gone;
      co_return co_await answer(*request, http::to_response(*problem), version, false);
    }
    auto response = co_await asio::co_spawn(
        state_->workers, [this, &request]() -> asio::awaitable<http::Response> { co_return handle(*request); },
        asio::use_awaitable);
    co_return co_await answer(*request, std::move(response), version, message.keep_alive());
  }

  http::Response handle(http::Request& request) {
    try {
      return state_->application.handle(request);
    } catch (const std::exception& fault) {
      log::error(request.method + " " + request.path + ": " + fault.what());
      return http::to_response(http::make_problem("internal", "the request could not be served"));
    }
  }

  asio::awaitable<Next> refuse_header(const boost::system::error_code& fault) {
    using E = beast::http::error;
    if (fault.category() != beast::http::make_error_code(E::bad_value).category() || fault == E::end_of_stream ||
        fault == E::partial_message)
      co_return Next::gone;
    auto problem = http::make_problem("malformed-request", "not an HTTP request: " + fault.message());
    if (fault == E::header_limit)
      problem =
          http::make_problem("header-too-large", "the header has more than " +
                                                     std::to_string(state_->config.limits.max_header_bytes) + " bytes");
    if (fault == E::bad_version) problem = http::make_problem("http-version", "the request speaks another version");
    http::Request unknown;
    unknown.method = "GET";
    co_return co_await answer(unknown, http::to_response(problem), 11, false);
  }

  /// nullopt when the body is in the request; a problem without slug when the client is gone.
  asio::awaitable<std::optional<http::Problem>> read_body(Parser& parser, const http::BodyPlan& plan,
                                                          http::Request& request) {
    const auto length = parser.content_length();
    if (length && *length > plan.max_bytes) co_return BodySink::too_large(plan);
    if (plan.required && !length && !parser.chunked())
      co_return http::make_problem("length-required", "the request has neither Content-Length nor chunks");
    if (const auto expect = request.header("Expect")) {
      if (!http::equal_ignoring_case(*expect, "100-continue"))
        co_return http::make_problem("malformed-request", "only Expect: 100-continue is known");
      stream_.expires_after(state_->config.limits.write_timeout);
      constexpr std::string_view go_on = "HTTP/1.1 100 Continue\r\n\r\n";
      const auto [error, count] =
          co_await asio::async_write(stream_, asio::buffer(go_on.data(), go_on.size()), use_tuple);
      if (error) co_return gone();
    }
    BodySink sink(plan, *state_, request);
    std::vector<char> piece(parser.is_done() ? 0 : piece_bytes);
    while (!parser.is_done()) {
      auto& body = parser.get().body();
      body.data = piece.data();
      body.size = piece.size();
      body.more = true;
      stream_.expires_after(state_->config.limits.read_timeout);
      auto [error, count] = co_await beast::http::async_read_some(stream_, buffer_, parser, use_tuple);
      if (error && error != beast::http::error::need_buffer) {
        if (error.category() == beast::http::make_error_code(beast::http::error::bad_chunk).category() &&
            error != beast::http::error::partial_message && error != beast::http::error::end_of_stream)
          co_return http::make_problem("malformed-request", "the body cannot be read: " + error.message());
        co_return gone();
      }
      if (auto problem = sink.append({piece.data(), piece.size() - body.size})) co_return problem;
    }
    co_return std::nullopt;
  }

  static http::Problem gone() {
    http::Problem problem;
    problem.slug.clear();
    return problem;
  }

  /// Beast would answer these in plain text.
  static std::optional<http::Response> handshake_fault(const http::Request& request) {
    constexpr std::size_t key_characters = 24;  // 16 bytes in base64
    if (request.header("Sec-WebSocket-Version").value_or("") != "13") {
      auto response = http::to_response(
          http::make_problem("upgrade-required", "Sec-WebSocket-Version must be 13, the one that is spoken here"));
      response.headers["Sec-WebSocket-Version"] = "13";
      return response;
    }
    if (request.header("Sec-WebSocket-Key").value_or("").size() != key_characters)
      return http::to_response(http::make_problem("malformed-request", "Sec-WebSocket-Key must be 16 bytes in base64"));
    return std::nullopt;
  }

  asio::awaitable<Next> upgrade(Parser& parser, const http::Request& request) {
    if (auto fault = handshake_fault(request)) co_return co_await answer(request, std::move(*fault), 11, false);
    if (buffer_.size() != 0)
      co_return co_await answer(
          request, http::to_response(http::make_problem("malformed-request", "bytes follow the upgrade request")), 11,
          false);
    // Last of all: a peer has a place in its stream until it is told that its connection is gone.
    auto opened = state_->application.open_websocket(request);
    if (auto* refusal = std::get_if<http::Response>(&opened))
      co_return co_await answer(request, std::move(*refusal), 11, false);
    beast::http::request<beast::http::empty_body> head(std::move(parser.get().base()));
    serve_websocket(stream_.release_socket(), std::move(head),
                    std::move(std::get<std::shared_ptr<http::WebSocketPeer>>(opened)), state_, std::move(count_));
    co_return Next::gone;
  }

  beast::tcp_stream stream_;
  std::shared_ptr<SharedState> state_;
  ConnectionCount count_;
  beast::flat_buffer buffer_;
};

}  // namespace

asio::awaitable<void> serve_connection(asio::ip::tcp::socket socket, std::shared_ptr<SharedState> state,
                                       ConnectionCount count) {
  // Small answers and stream frames go out at once.
  boost::system::error_code ignored;
  socket.set_option(asio::ip::tcp::no_delay(true), ignored);
  Session session(std::move(socket), std::move(state), std::move(count));
  co_await session.run();
}

}  // namespace semblante::net
