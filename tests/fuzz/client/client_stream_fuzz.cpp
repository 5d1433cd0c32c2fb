// What a server may say to the WebSocket of clients/native. The first byte of the input says how: 'j' in the JSON
// subprotocol, 'h' with an answer to the handshake of the input's own; the rest is the server's bytes.

#include <array>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <string>

#include <openssl/evp.h>
#include <openssl/sha.h>

#include "clients/native/client/live_stream.h"
#include "tests/fuzz/client/hostile_server.h"

using namespace semblante;

namespace {

/// The answer of a server that agrees (RFC 6455 section 4.2.2).
std::string agreeing(std::string_view head) {
  constexpr std::string_view field = "Sec-WebSocket-Key: ";
  constexpr std::size_t key_size = 24;
  const auto at = head.find(field);
  if (at == std::string_view::npos) std::abort();
  const std::string key =
      std::string(head.substr(at + field.size(), key_size)) + "258EAFA5-E914-47DA-95CA-C5AB0DC85B11";
  std::array<unsigned char, SHA_DIGEST_LENGTH> digest{};
  SHA1(reinterpret_cast<const unsigned char*>(key.data()), key.size(), digest.data());
  std::array<unsigned char, 32> text{};
  EVP_EncodeBlock(text.data(), digest.data(), SHA_DIGEST_LENGTH);
  const bool json = head.find("semblante.v1.json") != std::string_view::npos;
  return "HTTP/1.1 101 Switching Protocols\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Accept: " +
         std::string(reinterpret_cast<const char*>(text.data())) +
         "\r\nSec-WebSocket-Protocol: " + (json ? "semblante.v1.json" : "semblante.v1") + "\r\n\r\n";
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static auto& server = *new fuzz::HostileServer;
  if (size == 0) return 0;
  const char how = static_cast<char>(data[0]);
  const std::string said(reinterpret_cast<const char*>(data) + 1, size - 1);
  server.answer_with([&](std::string_view head) { return how == 'h' ? said : agreeing(head) + said; });

  client::LiveStreamOptions options;
  options.socket.json = how == 'j';
  options.socket.timeout = std::chrono::seconds(3);
  options.first_pause = options.longest_pause = std::chrono::minutes(1);  // one connection
  const auto begin = std::chrono::steady_clock::now();
  client::LiveStream stream(client::Url{"127.0.0.1", server.port(), ""}, "s", options);
  while (true) {
    const auto event = stream.next(options.socket.timeout);
    if (!event && event.error().message.empty()) std::abort();
    if (!event || event->type == SEMBLANTE_EVENT_NONE) break;
    const auto state = stream.machine().state();
    if (state == SEMBLANTE_STREAM_WAITING || state == SEMBLANTE_STREAM_CLOSED) break;
  }
  if (stream.loss() && stream.loss()->message.empty()) std::abort();
  stream.close();
  // The server closes after its last byte, so nothing is left to wait for.
  if (std::chrono::steady_clock::now() - begin >= options.socket.timeout) std::abort();
  return 0;
}
