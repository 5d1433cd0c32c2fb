#pragma once

#include <array>
#include <cstdlib>
#include <functional>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <unistd.h>

#include <netinet/in.h>
#include <sys/socket.h>

namespace semblante::fuzz {

/// A server on a free port of this machine. It reads the head of one request per connection, answers with what the
/// input says, and reads on until the client goes. Lives as long as the program.
class HostileServer {
 public:
  /// The answer to a request's head.
  using Answer = std::function<std::string(std::string_view head)>;

  HostileServer() : listener_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    if (::bind(listener_, reinterpret_cast<const sockaddr*>(&address), size) != 0 || ::listen(listener_, 16) != 0 ||
        ::getsockname(listener_, reinterpret_cast<sockaddr*>(&address), &size) != 0)
      std::abort();
    port_ = ntohs(address.sin_port);
    std::thread([this] {
      while (true) serve();
    }).detach();
  }

  [[nodiscard]] std::string port() const { return std::to_string(port_); }
  /// For the connections from now on.
  void answer_with(Answer answer) {
    const std::lock_guard lock(mutex_);
    answer_ = std::move(answer);
  }

 private:
  void serve() {
    const int peer = ::accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC);
    if (peer < 0) std::abort();
    std::array<char, 4096> piece{};
    std::string head;
    while (head.find("\r\n\r\n") == std::string::npos) {
      const auto count = ::recv(peer, piece.data(), piece.size(), 0);
      if (count <= 0) break;
      head.append(piece.data(), static_cast<std::size_t>(count));
    }
    std::string answer;
    {
      const std::lock_guard lock(mutex_);
      answer = answer_(head);
    }
    for (std::string_view rest = answer; !rest.empty();) {
      const auto count = ::send(peer, rest.data(), rest.size(), MSG_NOSIGNAL);
      if (count <= 0) break;
      rest.remove_prefix(static_cast<std::size_t>(count));
    }
    ::shutdown(peer, SHUT_WR);
    while (::recv(peer, piece.data(), piece.size(), 0) > 0) {
    }
    ::close(peer);
  }

  const int listener_;
  std::uint16_t port_ = 0;
  std::mutex mutex_;
  Answer answer_;
};

}  // namespace semblante::fuzz
