#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <poll.h>
#include <string>
#include <string_view>
#include <unistd.h>

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/socket.h>

#include "tests/support/wait.h"

namespace semblante::net {

inline std::string get(std::string_view path) {
  return "GET " + std::string(path) + " HTTP/1.1\r\nHost: localhost\r\n\r\n";
}

/// A socket that says what a test wants, byte by byte.
class Client {
 public:
  /// `address`: of this machine, in the byte order of the host.
  explicit Client(std::uint16_t port, std::uint32_t address = INADDR_LOOPBACK)
      : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(port);
    to.sin_addr.s_addr = htonl(address);
    EXPECT_EQ(::connect(socket_, reinterpret_cast<const sockaddr*>(&to), sizeof to), 0);
  }
  ~Client() { ::close(socket_); }
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

  void send(std::string_view bytes) const {
    EXPECT_EQ(::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL), static_cast<ssize_t>(bytes.size()));
  }
  /// So many bytes, or fewer when the connection ends before, or nothing comes for long.
  [[nodiscard]] std::string read(std::size_t count) const {
    std::string all;
    std::array<char, 1> piece{};
    constexpr int poll_ms = std::chrono::milliseconds(testing::patience).count();
    while (all.size() < count) {
      pollfd waiting{socket_, POLLIN, 0};
      if (::poll(&waiting, 1, poll_ms) != 1 || ::recv(socket_, piece.data(), 1, 0) != 1) break;
      all += piece[0];
    }
    return all;
  }
  /// False when the connection has ended.
  [[nodiscard]] bool try_send(std::string_view bytes) const {
    return ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(bytes.size());
  }
  /// What is there, at most 64 KiB; nullopt at the end.
  [[nodiscard]] std::optional<std::string> read_piece() const {
    std::string piece(65536, '\0');
    const auto got = ::recv(socket_, piece.data(), piece.size(), 0);
    if (got <= 0) return std::nullopt;
    piece.resize(static_cast<std::size_t>(got));
    return piece;
  }
  /// Its length; 0 at the end.
  [[nodiscard]] std::size_t read_some() const {
    const auto piece = read_piece();
    return piece ? piece->size() : 0;
  }
  /// Whether the server has ended the connection, after the bytes that are on their way.
  [[nodiscard]] bool has_ended() const {
    constexpr int poll_ms = std::chrono::milliseconds(testing::patience).count();
    char byte = 0;
    for (pollfd waiting{socket_, POLLIN, 0}; ::poll(&waiting, 1, poll_ms) == 1;)
      if (::recv(socket_, &byte, 1, 0) <= 0) return true;
    return false;
  }
  [[nodiscard]] std::string read_head() const {
    std::string head;
    while (!head.ends_with("\r\n\r\n")) {
      const auto more = read(1);
      if (more.empty()) break;
      head += more;
    }
    return head;
  }
  void upgrade() const {
    send(upgrade_request);
    EXPECT_TRUE(read_head().starts_with("HTTP/1.1 101 "));
  }
  /// One whole text message in one frame; the mask of zeros leaves it as it is.
  void say(std::string_view text) const { send(frame('\x81', text)); }
  static std::string frame(char first, std::string_view payload) {
    EXPECT_LT(payload.size(), 126U);
    std::string bytes{first, static_cast<char>(0x80U | payload.size()), 0, 0, 0, 0};
    return bytes.append(payload);
  }

  static constexpr std::string_view upgrade_request =
      "GET /echo HTTP/1.1\r\nHost: localhost\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n"
      "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n";

 private:
  int socket_;
};

}  // namespace semblante::net
