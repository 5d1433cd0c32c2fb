#include "clients/gateways/net/udp_socket.h"

#include <cerrno>
#include <charconv>
#include <cstring>
#include <memory>
#include <netdb.h>
#include <poll.h>
#include <unistd.h>
#include <utility>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>

namespace semblante::gateways {
namespace {

/// The largest packet of UDP, and one byte more.
constexpr std::size_t buffer_bytes = 65'536;
/// Size of the system's queue: a few hundred packets, for times without a server or with a slow one.
constexpr int queue_bytes = 512 * 1024;

using Addresses = std::unique_ptr<addrinfo, decltype(&freeaddrinfo)>;

Result<Addresses> resolve(const Endpoint& endpoint, int flags) {
  addrinfo hints{};
  hints.ai_socktype = SOCK_DGRAM;
  hints.ai_flags = flags | AI_NUMERICSERV;
  addrinfo* found = nullptr;
  if (const int problem = getaddrinfo(endpoint.host.c_str(), endpoint.port.c_str(), &hints, &found); problem != 0) {
    return Error{ErrorCode::invalid_argument, endpoint.host, gai_strerror(problem)};
  }
  return Addresses(found, &freeaddrinfo);
}

bool is_loopback(const sockaddr& address) {
  if (address.sa_family == AF_INET) {
    sockaddr_in four{};
    std::memcpy(&four, &address, sizeof(four));
    return ntohl(four.sin_addr.s_addr) >> 24U == 127;
  }
  if (address.sa_family != AF_INET6) return false;
  sockaddr_in6 six{};
  std::memcpy(&six, &address, sizeof(six));
  return IN6_IS_ADDR_LOOPBACK(&six.sin6_addr) != 0;
}

Error system_error(const Endpoint& endpoint, const char* step) {
  return {ErrorCode::io, endpoint.host + ":" + endpoint.port, std::string(step) + ": " + std::strerror(errno)};
}

}  // namespace

Result<Endpoint> parse_endpoint(const std::string& text, const std::string& usual_port) {
  Endpoint endpoint{text, usual_port};
  const std::size_t bracket = text.rfind(']');
  const std::size_t colon = text.rfind(':');
  // An IPv6 address without brackets has several colons, and none of them begins a port.
  const bool one_colon = colon != std::string::npos && text.find(':') == colon;
  if (colon != std::string::npos && (bracket == std::string::npos ? one_colon : colon > bracket)) {
    endpoint = {text.substr(0, colon), text.substr(colon + 1)};
  }
  if (endpoint.host.size() > 2 && endpoint.host.front() == '[' && endpoint.host.back() == ']') {
    endpoint.host = endpoint.host.substr(1, endpoint.host.size() - 2);
  }
  unsigned port = 0;
  const char* end = endpoint.port.data() + endpoint.port.size();
  const auto [stop, problem] = std::from_chars(endpoint.port.data(), end, port);
  if (endpoint.host.empty() || problem != std::errc{} || stop != end || port > 65535) {
    return Error{ErrorCode::invalid_argument, text, "an address must be HOST:PORT with a port from 0 to 65535"};
  }
  return endpoint;
}

UdpSocket::UdpSocket(int handle) : handle_(handle), buffer_(buffer_bytes) {}

UdpSocket::~UdpSocket() {
  if (handle_ >= 0) ::close(handle_);
}

UdpSocket::UdpSocket(UdpSocket&& other) noexcept
    : handle_(std::exchange(other.handle_, -1)), buffer_(std::move(other.buffer_)) {}

UdpSocket& UdpSocket::operator=(UdpSocket&& other) noexcept {
  std::swap(handle_, other.handle_);
  std::swap(buffer_, other.buffer_);
  return *this;
}

Result<UdpSocket> UdpSocket::listen(const Endpoint& at) {
  const auto addresses = resolve(at, AI_NUMERICHOST | AI_PASSIVE);
  if (!addresses) return addresses.error();
  const addrinfo& address = **addresses;
  const int handle = ::socket(address.ai_family, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (handle < 0) return system_error(at, "cannot create a socket");
  UdpSocket socket(handle);
  // The system may give less; packets over the limit are lost, as in the network.
  static_cast<void>(::setsockopt(handle, SOL_SOCKET, SO_RCVBUF, &queue_bytes, sizeof(queue_bytes)));
  if (::bind(handle, address.ai_addr, address.ai_addrlen) != 0)
    return system_error(at, "cannot listen at this address");
  return socket;
}

Result<UdpSocket> UdpSocket::send_to(const Endpoint& to, bool anywhere) {
  const auto addresses = resolve(to, 0);
  if (!addresses) return addresses.error();
  const addrinfo& address = **addresses;
  if (!anywhere && !is_loopback(*address.ai_addr)) {
    return Error{ErrorCode::invalid_argument, to.host,
                 "is another machine; use --anywhere if its owner agrees to receive packets"};
  }
  const int handle = ::socket(address.ai_family, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (handle < 0) return system_error(to, "cannot create a socket");
  UdpSocket socket(handle);
  if (::connect(handle, address.ai_addr, address.ai_addrlen) != 0)
    return system_error(to, "cannot send to this address");
  return socket;
}

std::uint16_t UdpSocket::port() const {
  sockaddr_storage address{};
  socklen_t size = sizeof(address);
  if (::getsockname(handle_, reinterpret_cast<sockaddr*>(&address), &size) != 0) return 0;
  if (address.ss_family == AF_INET6) {
    sockaddr_in6 six{};
    std::memcpy(&six, &address, sizeof(six));
    return ntohs(six.sin6_port);
  }
  sockaddr_in four{};
  std::memcpy(&four, &address, sizeof(four));
  return ntohs(four.sin_port);
}

bool UdpSocket::wait(std::chrono::milliseconds timeout) {
  pollfd entry{handle_, POLLIN, 0};
  return ::poll(&entry, 1, static_cast<int>(timeout.count())) > 0;
}

std::optional<std::span<const std::uint8_t>> UdpSocket::receive() {
  const ssize_t size = ::recv(handle_, buffer_.data(), buffer_.size(), 0);
  if (size < 0) return std::nullopt;
  return std::span<const std::uint8_t>(buffer_.data(), static_cast<std::size_t>(size));
}

bool UdpSocket::send(std::span<const std::uint8_t> packet) {
  return ::send(handle_, packet.data(), packet.size(), 0) == static_cast<ssize_t>(packet.size());
}

}  // namespace semblante::gateways
