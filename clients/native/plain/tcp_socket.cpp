#include "clients/native/plain/tcp_socket.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <memory>
#include <netdb.h>
#include <poll.h>
#include <string>
#include <unistd.h>
#include <utility>

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>

namespace semblante::client {
namespace {

using Clock = TcpSocket::Clock;

Error failed(const char* what, int number) {
  return {ErrorCode::io, "socket", std::string(what) + ": " + strerror(number)};
}

/// Whether the socket became ready before the deadline.
bool is_ready(int descriptor, short events, Clock::time_point deadline) {
  while (true) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now()).count();
    pollfd wait{descriptor, events, 0};
    const int count = ::poll(&wait, 1, static_cast<int>(std::clamp<std::int64_t>(left, 0, 1'000'000)));
    if (count > 0) return true;
    if (count == 0 || errno != EINTR) return false;
  }
}

}  // namespace

TcpSocket::~TcpSocket() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

TcpSocket::TcpSocket(TcpSocket&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}

TcpSocket& TcpSocket::operator=(TcpSocket&& other) noexcept {
  std::swap(descriptor_, other.descriptor_);
  return *this;
}

Result<TcpSocket> TcpSocket::open(const Url& url, Clock::time_point deadline) {
  if (url.secure) {
    return Error{ErrorCode::unsupported, url.authority(), "https needs TLS, which this program does not have"};
  }
  addrinfo wish{};
  wish.ai_socktype = SOCK_STREAM;
  addrinfo* list = nullptr;
  if (::getaddrinfo(url.host.c_str(), url.port.c_str(), &wish, &list) != 0) {
    return Error{ErrorCode::io, url.authority(), "cannot find the host"};
  }
  const std::unique_ptr<addrinfo, void (*)(addrinfo*)> addresses(list, ::freeaddrinfo);
  int problem = ETIMEDOUT;
  for (const addrinfo* each = list; each != nullptr; each = each->ai_next) {
    TcpSocket socket(::socket(each->ai_family, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, each->ai_protocol));
    if (socket.descriptor_ < 0) {
      problem = errno;
      continue;
    }
    if (::connect(socket.descriptor_, each->ai_addr, each->ai_addrlen) != 0) {
      problem = errno;
      if (problem != EINPROGRESS) continue;
      problem = ETIMEDOUT;
      if (!is_ready(socket.descriptor_, POLLOUT, deadline)) continue;
      socklen_t size = sizeof(problem);
      ::getsockopt(socket.descriptor_, SOL_SOCKET, SO_ERROR, &problem, &size);
      if (problem != 0) continue;
    }
    const int on = 1;
    ::setsockopt(socket.descriptor_, IPPROTO_TCP, TCP_NODELAY, &on, sizeof(on));
    return socket;
  }
  return Error{ErrorCode::io, url.authority(), std::string("cannot connect: ") + strerror(problem)};
}

Status TcpSocket::send(std::span<const std::uint8_t> bytes, Clock::time_point deadline) {
  while (!bytes.empty()) {
    const ssize_t sent = ::send(descriptor_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (sent >= 0) {
      bytes = bytes.subspan(static_cast<std::size_t>(sent));
    } else if (errno != EAGAIN && errno != EINTR) {
      return failed("cannot send", errno);
    } else if (!is_ready(descriptor_, POLLOUT, deadline)) {
      return failed("cannot send", ETIMEDOUT);
    }
  }
  return Unit{};
}

Result<std::optional<std::size_t>> TcpSocket::receive(std::span<std::uint8_t> into, Clock::time_point deadline) {
  using Count = std::optional<std::size_t>;
  while (true) {
    const ssize_t count = ::recv(descriptor_, into.data(), into.size(), 0);
    if (count >= 0) return Count(static_cast<std::size_t>(count));
    if (errno != EAGAIN && errno != EINTR) return failed("cannot receive", errno);
    if (!is_ready(descriptor_, POLLIN, deadline)) return Count();
  }
}

}  // namespace semblante::client
