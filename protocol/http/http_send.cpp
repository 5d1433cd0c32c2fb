// HttpClient::send() by Boost.Beast.
#include <algorithm>
#include <exception>

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/redirect_error.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http.hpp>

#include "core/types/letter_case.h"
#include "protocol/http/connection.h"
#include "protocol/http/http_client.h"

namespace semblante::client {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
using boost::system::error_code;

/// Limit of the unparsed bytes of an answer.
constexpr std::size_t most_unparsed = std::size_t{60} << 10U;

Error failed(const Url& url, const char* step, const error_code& problem) {
  const ErrorCode code = problem == http::error::body_limit || problem == http::error::header_limit ||
                                 problem == http::error::buffer_overflow
                             ? ErrorCode::too_large
                         : problem.category() == http::make_error_code(http::error::end_of_stream).category() &&
                                 problem != http::error::end_of_stream && problem != http::error::partial_message
                             ? ErrorCode::malformed
                             : ErrorCode::io;
  return {code, url.authority(), std::string(step) + ": " + problem.message()};
}

http::request<http::string_body> to_beast(const ServerAddress& server, const HttpRequest& request) {
  http::request<http::string_body> message;
  message.version(11);
  message.method_string(request.method);
  message.target(server.url.path + request.target);
  message.set(http::field::host, server.url.authority());
  message.set(http::field::user_agent, "semblante-client");
  message.set(http::field::connection, "close");
  if (!request.content_type.empty()) {
    message.set(http::field::content_type, request.content_type);
  }
  if (!server.token.empty()) {
    message.set(http::field::authorization, "Bearer " + server.token);
  }
  for (const auto& [name, value] : request.headers) {
    message.set(name, value);
  }
  message.body() = request.body;
  message.prepare_payload();
  return message;
}

HttpResponse from_beast(http::response<http::string_body>&& message) {
  HttpResponse response;
  response.status = static_cast<int>(message.result_int());
  response.reason = std::string(message.reason());
  for (const auto& field : message) {
    response.headers.emplace_back(lower_case(std::string(field.name_string())), std::string(field.value()));
  }
  response.body = std::move(message.body());
  return response;
}

asio::awaitable<void> exchange(const ServerAddress& server, const HttpLimits& limits, const HttpRequest& request,
                               std::optional<Result<HttpResponse>>& outcome) {
  const auto executor = co_await asio::this_coro::executor;
  const Url& url = server.url;
  error_code problem;
  auto token = asio::redirect_error(asio::use_awaitable, problem);
  asio::ip::tcp::resolver resolver(executor);
  const auto endpoints = co_await resolver.async_resolve(url.host, url.port, token);
  if (problem) {
    outcome = failed(url, "cannot find the host", problem);
    co_return;
  }
  Connection stream(executor);
  co_await stream.next_layer().async_connect(endpoints, token);
  if (problem) {
    outcome = failed(url, "cannot connect", problem);
    co_return;
  }
  if (auto ready = stream.secure(server); !ready) {
    outcome = std::move(ready).error();
    co_return;
  }
  co_await stream.async_handshake(token);
  if (problem) {
    outcome = handshake_failed(stream, url, problem);
    co_return;
  }
  auto message = to_beast(server, request);
  co_await http::async_write(stream, message, token);
  // A server may answer and close before it has read a refused body completely: the answer takes precedence over the
  // write error.
  const error_code write_problem = problem;
  // Also bounds trailers and chunk extensions: Beast stores them completely, and throws on a field of more than 64 KiB.
  beast::flat_buffer buffer(most_unparsed);
  http::response_parser<http::string_body> parser;
  parser.body_limit(limits.max_body);
  parser.header_limit(static_cast<std::uint32_t>(std::min(limits.max_header, most_unparsed)));
  parser.skip(request.method == "HEAD");
  co_await http::async_read(stream, buffer, parser, token);
  if (problem) {
    outcome =
        write_problem ? failed(url, "cannot send", write_problem) : failed(url, "cannot read the answer", problem);
    co_return;
  }
  outcome = from_beast(parser.release());
}

}  // namespace

Result<HttpResponse> HttpClient::send(const HttpRequest& request) const {
  asio::io_context io(1);
  std::optional<Result<HttpResponse>> outcome;
  std::exception_ptr fault;
  asio::co_spawn(io, exchange(server_, limits_, request, outcome), [&](std::exception_ptr f) { fault = std::move(f); });
  try {
    io.run_for(limits_.timeout);
  } catch (...) {
    fault = std::current_exception();
  }
  if (outcome) {
    return *std::move(outcome);
  }
  const std::string where = server_.url.authority() + request.target;
  if (fault) {
    return Error{ErrorCode::internal, where, "the exchange failed unexpectedly"};
  }
  return Error{ErrorCode::io, where, "no complete answer within " + std::to_string(limits_.timeout.count()) + " ms"};
}

}  // namespace semblante::client
