#pragma once

#include <atomic>
#include <chrono>
#include <poll.h>
#include <string>
#include <thread>
#include <unistd.h>

#include <netinet/in.h>
#include <sys/socket.h>

namespace semblante::testing {

/// Accepts connections on a free port, one after another: reads a request's head, writes given bytes whatever it says,
/// and closes; or keeps silent when the bytes are empty.
class CannedServer {
 public:
  explicit CannedServer(std::string answer, int connections = 1)
      : answer_(std::move(answer)), listener_(socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof(address);
    const bool listening = bind(listener_, reinterpret_cast<sockaddr*>(&address), size) == 0 &&
                           listen(listener_, 4) == 0 &&
                           getsockname(listener_, reinterpret_cast<sockaddr*>(&address), &size) == 0;
    port_ = listening ? ntohs(address.sin_port) : 0;
    thread_ = std::thread([this, connections] {
      for (int i = 0; i < connections; ++i) serve();
    });
  }
  ~CannedServer() {
    stop_ = true;
    thread_.join();
    close(listener_);
  }
  CannedServer(const CannedServer&) = delete;
  CannedServer& operator=(const CannedServer&) = delete;

  [[nodiscard]] std::string url() const { return "http://127.0.0.1:" + std::to_string(port_); }
  [[nodiscard]] const std::string& request() const { return request_; }

 private:
  [[nodiscard]] bool readable(int socket) const {
    while (!stop_) {
      pollfd entry{socket, POLLIN, 0};
      if (poll(&entry, 1, 20) > 0) {
        return true;
      }
    }
    return false;
  }

  void serve() {
    if (!readable(listener_)) {
      return;
    }
    const int peer = accept(listener_, nullptr, nullptr);
    request_.clear();
    char buffer[4096];
    while (request_.find("\r\n\r\n") == std::string::npos && readable(peer)) {
      const ssize_t size = recv(peer, buffer, sizeof(buffer), 0);
      if (size <= 0) {
        break;
      }
      request_.append(buffer, static_cast<std::size_t>(size));
    }
    for (std::size_t sent = 0; sent < answer_.size();) {
      const ssize_t size = send(peer, answer_.data() + sent, answer_.size() - sent, MSG_NOSIGNAL);
      if (size <= 0) {
        break;
      }
      sent += static_cast<std::size_t>(size);
    }
    while (answer_.empty() && !stop_) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    close(peer);
  }

  std::string answer_;
  int listener_;
  std::uint16_t port_ = 0;
  std::string request_;
  std::atomic<bool> stop_ = false;
  std::thread thread_;
};

}  // namespace semblante::testing
