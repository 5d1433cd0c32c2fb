#include "server/net/http_client.h"

#include <chrono>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/string_body.hpp>
#include <boost/beast/http/write.hpp>

namespace semblante::net {

namespace asio = boost::asio;
namespace beast = boost::beast;

namespace {

constexpr std::chrono::seconds patience{30};
constexpr std::size_t most_bytes = std::size_t{64} << 20U;
constexpr std::size_t most_unparsed = std::size_t{32} << 10U;

}  // namespace

Result<ServerAddress> parse_server_address(std::string_view url) {
  const auto wrong = [&](const char* why) { return Error{ErrorCode::invalid_argument, std::string(url), why}; };
  constexpr std::string_view scheme = "http://";
  if (!url.starts_with(scheme)) return wrong("must begin with http:// (TLS is not spoken here)");
  auto rest = url.substr(scheme.size());
  if (rest.ends_with('/')) rest.remove_suffix(1);
  if (rest.empty() || rest.find_first_of("/?#@ ") != std::string_view::npos) return wrong("must be http://HOST:PORT");
  const bool bracketed = rest.front() == '[';
  const auto end = bracketed ? rest.find(']') : rest.find(':');
  if (bracketed && end == std::string_view::npos) return wrong("the address has no closing bracket");
  ServerAddress address;
  address.host = bracketed ? rest.substr(1, end - 1) : rest.substr(0, end);
  auto port = end == std::string_view::npos ? std::string_view{} : rest.substr(bracketed ? end + 1 : end);
  if (port.starts_with(':')) port.remove_prefix(1);
  if (port.find_first_not_of("0123456789") != std::string_view::npos || port.size() > 5)
    return wrong("the port must be a number");
  address.port = port.empty() ? "80" : std::string(port);
  if (address.host.empty()) return wrong("must be http://HOST:PORT");
  return address;
}

Result<ClientResponse> ask(const ServerAddress& server, const ClientRequest& request) {
  const bool six = server.host.find(':') != std::string::npos;
  const std::string host = (six ? "[" + server.host + "]" : server.host) + ":" + server.port;
  const auto failed = [&](const boost::system::error_code& error) {
    return Error{ErrorCode::io, host, error.message()};
  };
  asio::io_context io;
  boost::system::error_code error;
  const auto endpoints = asio::ip::tcp::resolver(io).resolve(server.host, server.port, error);
  if (error) return failed(error);

  beast::http::request<beast::http::string_body> message;
  message.version(11);
  message.method_string(request.method);
  message.target(request.target);
  message.set(beast::http::field::host, host);
  message.set(beast::http::field::connection, "close");
  if (!request.content_type.empty()) message.set(beast::http::field::content_type, request.content_type);
  message.body() = request.body;
  message.prepare_payload();

  // Asynchronous, since the stream's clock runs for nothing else.
  beast::tcp_stream stream(io);
  // Also bounds trailers and chunk extensions: Beast keeps them whole, and throws on a field of more than 64 KiB.
  beast::flat_buffer buffer(most_unparsed);
  beast::http::response_parser<beast::http::string_body> parser;
  parser.body_limit(most_bytes);
  const auto run = [&] {
    io.restart();
    try {
      io.run();
    } catch (const std::exception&) {  // of Beast, by what the server sent
      error = beast::http::error::bad_field;
    }
  };
  const auto note = [&](const boost::system::error_code& result, auto&&...) { error = result; };
  stream.expires_after(patience);
  stream.async_connect(endpoints, note);
  run();
  if (error) return failed(error);
  beast::http::async_write(stream, message, note);
  run();
  // A server that refuses a body before it has all of it may close: what it said is still to be read.
  beast::http::async_read(stream, buffer, parser, note);
  run();
  if (error) return failed(error);
  ClientResponse response;
  response.status = parser.get().result_int();
  const auto location = parser.get()[beast::http::field::location];
  response.location = std::string(location.data(), location.size());
  response.body = std::move(parser.get().body());
  return response;
}

}  // namespace semblante::net
