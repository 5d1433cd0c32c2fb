// HttpClient::send() over a TcpSocket.
#include <array>
#include <chrono>

#include "clients/native/plain/http_answer.h"
#include "clients/native/plain/tcp_socket.h"
#include "protocol/http/http_client.h"

namespace semblante::client {
namespace {

std::string to_text(const ServerAddress& server, const HttpRequest& request) {
  std::string text = request.method + " " + server.url.path + request.target + " HTTP/1.1\r\n";
  const auto add = [&](std::string_view name, std::string_view value) {
    text.append(name).append(": ").append(value).append("\r\n");
  };
  add("Host", server.url.authority());
  add("User-Agent", "semblante-client");
  add("Connection", "close");
  if (!request.content_type.empty()) add("Content-Type", request.content_type);
  if (!server.token.empty()) add("Authorization", "Bearer " + server.token);
  for (const auto& [name, value] : request.headers) add(name, value);
  if (request.method != "GET" && request.method != "HEAD") add("Content-Length", std::to_string(request.body.size()));
  return text + "\r\n" + request.body;
}

}  // namespace

Result<HttpResponse> HttpClient::send(const HttpRequest& request) const {
  const auto deadline = TcpSocket::Clock::now() + limits_.timeout;
  auto socket = TcpSocket::open(server_.url, deadline);
  if (!socket) return std::move(socket).error();
  const std::string text = to_text(server_, request);
  // A server may answer and close before it has read a refused body completely: its answer takes precedence.
  const auto sent = socket->send({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}, deadline);
  const std::string where = server_.url.authority() + request.target;
  HttpAnswer answer(limits_, request.method == "HEAD");
  std::array<std::uint8_t, 16'384> piece;
  while (true) {
    auto count = socket->receive(piece, deadline);
    if (!count) return Error{ErrorCode::io, where, sent ? count.error().message : sent.error().message};
    if (!*count) {
      return Error{ErrorCode::io, where,
                   "no complete answer within " + std::to_string(limits_.timeout.count()) + " ms"};
    }
    if (**count == 0) {
      if (answer.close()) return std::move(answer.response());
      return Error{ErrorCode::io, where, sent ? "the answer ends before its end" : sent.error().message};
    }
    auto is_whole = answer.take({reinterpret_cast<const char*>(piece.data()), **count});
    if (!is_whole) return Error{is_whole.error().code, where, is_whole.error().message};
    if (*is_whole) return std::move(answer.response());
  }
}

}  // namespace semblante::client
