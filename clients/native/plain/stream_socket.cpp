// StreamSocket over a TcpSocket.
#include "clients/native/client/stream_socket.h"

#include <algorithm>
#include <array>
#include <random>
#include <utility>

#include "clients/native/client/stream_refusal.h"
#include "clients/native/plain/http_answer.h"
#include "clients/native/plain/tcp_socket.h"
#include "clients/native/plain/web_socket_key.h"
#include "clients/native/plain/web_socket_reader.h"
#include "core/json/base64.h"
#include "protocol/cpp/messages.h"

namespace semblante::client {
namespace {

using Clock = TcpSocket::Clock;

constexpr std::uint16_t normal_close = 1000;

std::span<const std::uint8_t> as_bytes(std::string_view text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

}  // namespace

struct StreamSocket::Impl {
  TcpSocket tcp;
  WebSocketReader reader;
  std::string where;
  SocketOptions options;
  std::array<std::uint8_t, 16'384> piece{};
  std::random_device random{};
  std::uint16_t close_code = 0;
  std::string close_reason{};
  bool is_open = true;

  Error ended(ErrorCode code, const std::string& why) {
    is_open = false;
    return {code, where, "the stream ended: " + why};
  }

  Status send(WebSocketKind kind, std::span<const std::uint8_t> bytes) {
    auto sent = tcp.send(web_socket_frame(kind, bytes, random()), Clock::now() + options.timeout);
    return sent ? sent : Status(Error{ErrorCode::io, where, sent.error().message});
  }

  /// The next message or the end of the connection; nullopt at the deadline.
  Result<std::optional<WebSocketReader::Message>> next(Clock::time_point deadline) {
    using Next = std::optional<WebSocketReader::Message>;
    // Also reads after the deadline, so that callers with a zero timeout make progress; not without end, since a server
    // that sends nothing but pings or empty fragments always makes something to read.
    constexpr int most_after_deadline = 64;
    int after_deadline = 0;
    while (is_open) {
      auto message = reader.next();
      if (!message) return ended(message.error().code, message.error().message);
      const bool is_late = Clock::now() >= deadline;
      if (is_late && ++after_deadline > most_after_deadline) return Next();
      if (!*message) {
        auto count = tcp.receive(piece, deadline);
        if (!count) return ended(ErrorCode::io, count.error().message);
        if (!*count) return Next();
        if (**count == 0) return ended(ErrorCode::io, "the connection was closed");
        reader.take(std::span(piece).first(**count));
        continue;
      }
      const auto bytes = (*message)->bytes;
      switch ((*message)->kind) {
        case WebSocketKind::ping:
          if (auto sent = send(WebSocketKind::pong, bytes); !sent) return ended(ErrorCode::io, sent.error().message);
          break;
        case WebSocketKind::pong:
          break;
        case WebSocketKind::close:
          if (bytes.size() >= 2) {
            close_code = static_cast<std::uint16_t>(bytes[0] << 8U | bytes[1]);
            close_reason.assign(bytes.begin() + 2, bytes.end());
          }
          // The connection ends, whether the answer arrives or not.
          static_cast<void>(send(WebSocketKind::close, bytes.first(std::min<std::size_t>(bytes.size(), 2))));
          return ended(ErrorCode::io, "the server has closed it");
        default:
          return message;
      }
    }
    return ended(ErrorCode::io, "the connection was closed");
  }
};

StreamSocket::StreamSocket(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
StreamSocket::~StreamSocket() = default;
StreamSocket::StreamSocket(StreamSocket&&) noexcept = default;
StreamSocket& StreamSocket::operator=(StreamSocket&&) noexcept = default;

Result<StreamSocket> StreamSocket::open(const ServerAddress& server, std::string_view stream,
                                        const SocketOptions& options) {
  const std::string target = server.url.path + "/v1/streams/" + escape_segment(stream);
  const std::string where = server.url.authority() + target;
  const auto deadline = Clock::now() + options.timeout;
  auto tcp = TcpSocket::open(server.url, deadline);
  if (!tcp) return std::move(tcp).error();
  std::random_device random;
  std::array<std::uint8_t, 16> nonce{};
  for (auto& byte : nonce) byte = static_cast<std::uint8_t>(random());
  const std::string key = to_base64(nonce);
  const std::string protocol(options.json ? json_subprotocol : binary_subprotocol);
  std::string request = "GET " + target + " HTTP/1.1\r\nHost: " + server.url.authority() +
                        "\r\nUser-Agent: semblante-client\r\nUpgrade: websocket\r\nConnection: Upgrade"
                        "\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Key: " +
                        key + "\r\nSec-WebSocket-Protocol: " + protocol + "\r\n";
  if (!server.token.empty()) request += "Authorization: Bearer " + server.token + "\r\n";
  if (auto sent = tcp->send(as_bytes(request + "\r\n"), deadline); !sent) return std::move(sent).error();

  const auto refused = [&](const std::string& why) {
    return Error{ErrorCode::io, where, "the stream refuses the connection: " + why};
  };
  HttpAnswer answer({.max_body = std::size_t{64} << 10U}, false);
  auto impl = std::unique_ptr<Impl>(
      new Impl{*std::move(tcp), WebSocketReader(options.json ? max_json_message_bytes : max_binary_message_bytes),
               where, options});
  for (bool is_whole = false; !is_whole;) {
    auto count = impl->tcp.receive(impl->piece, deadline);
    if (!count) return refused(count.error().message);
    if (!*count) return refused("no answer in time");
    if (**count == 0) {
      is_whole = answer.close();
      if (!is_whole) return refused("the connection was closed");
      break;
    }
    auto taken = answer.take({reinterpret_cast<const char*>(impl->piece.data()), **count});
    if (!taken) return refused(taken.error().message);
    is_whole = *taken;
  }
  const HttpResponse& response = answer.response();
  if (auto refusal = stream_refusal(response.status, response.body, where)) return *std::move(refusal);
  if (response.status != 101) return refused("the server answered " + std::to_string(response.status));
  if (response.header("sec-websocket-accept") != web_socket_accept(key)) return refused("this is no WebSocket");
  if (response.header("sec-websocket-protocol") != protocol) return no_such_subprotocol(protocol, where);
  impl->reader.take(as_bytes(answer.rest()));
  return StreamSocket(std::move(impl));
}

Result<std::optional<std::span<const std::uint8_t>>> StreamSocket::read(std::chrono::milliseconds timeout) {
  using Bytes = std::optional<std::span<const std::uint8_t>>;
  auto message = impl_->next(Clock::now() + timeout);
  if (!message) return std::move(message).error();
  return *message ? Bytes((*message)->bytes) : Bytes();
}

Status StreamSocket::send(std::span<const std::uint8_t> bytes) {
  return impl_->send(impl_->options.json ? WebSocketKind::text : WebSocketKind::binary, bytes);
}

void StreamSocket::close() {
  if (!impl_->is_open) return;
  constexpr std::array<std::uint8_t, 2> code = {normal_close >> 8U, normal_close & 0xFFU};
  if (!impl_->send(WebSocketKind::close, code)) return;
  // What still comes is not read.
  const auto deadline = Clock::now() + impl_->options.timeout;
  while (impl_->is_open && Clock::now() < deadline) static_cast<void>(impl_->next(deadline));
}

std::uint16_t StreamSocket::close_code() const { return impl_->close_code; }

std::string StreamSocket::close_reason() const { return impl_->close_reason; }

}  // namespace semblante::client
