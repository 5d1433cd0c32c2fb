#include "tests/bench/fanout/loopback.h"

#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <fcntl.h>
#include <unistd.h>

#include <arpa/inet.h>
#include <netinet/tcp.h>
#include <sys/socket.h>

namespace semblante::bench {
namespace {

/// Of the 28 thousand ports a source address has, so many are used, which leaves room for those in TIME_WAIT.
constexpr std::size_t connections_per_source = 12'000;

sockaddr* plain(sockaddr_in& address) { return reinterpret_cast<sockaddr*>(&address); }

}  // namespace

void give_up(const std::string& why) {
  std::fprintf(stderr, "bench_fanout: %s\n", why.c_str());
  std::exit(2);
}

std::int64_t now_ns() {
  timespec time{};
  clock_gettime(CLOCK_MONOTONIC, &time);
  return std::int64_t{time.tv_sec} * 1'000'000'000 + time.tv_nsec;
}

std::string Endpoint::authority() const {
  char text[INET_ADDRSTRLEN] = {};
  inet_ntop(AF_INET, &address.sin_addr, text, sizeof text);
  return std::string(text) + ":" + std::to_string(ntohs(address.sin_port));
}

Endpoint parse_endpoint(std::string_view text) {
  constexpr std::string_view after_scheme = "://";
  const auto at = text.find(after_scheme);
  const auto scheme = text.substr(0, at == std::string_view::npos ? 0 : at);
  const auto rest = scheme.empty() ? std::string_view() : text.substr(at + after_scheme.size());
  const auto colon = rest.find(':');
  Endpoint endpoint;
  endpoint.tls = scheme.ends_with("https");
  endpoint.address.sin_family = AF_INET;
  std::uint16_t port = 0;
  if (colon == std::string_view::npos || !(endpoint.tls || scheme.ends_with("http")) ||
      std::from_chars(rest.data() + colon + 1, rest.data() + rest.size(), port).ec != std::errc() ||
      inet_pton(AF_INET, std::string(rest.substr(0, colon)).c_str(), &endpoint.address.sin_addr) != 1)
    give_up("wanted http://127.0.0.1:PORT or https, not \"" + std::string(text) + "\"");
  if ((ntohl(endpoint.address.sin_addr.s_addr) >> 24U) != 127U)
    give_up("this program stays on loopback (127.0.0.0/8): " + std::string(text));
  endpoint.address.sin_port = htons(port);
  return endpoint;
}

Socket connect_to(const Endpoint& endpoint, int receive_buffer) {
  Socket socket(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
  const int on = 1;
  setsockopt(socket.get(), IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  if (receive_buffer > 0) setsockopt(socket.get(), SOL_SOCKET, SO_RCVBUF, &receive_buffer, sizeof receive_buffer);
  sockaddr_in address = endpoint.address;
  if (connect(socket.get(), plain(address), sizeof address) != 0)
    give_up("cannot connect to " + endpoint.authority() + ": " + std::strerror(errno));
  fcntl(socket.get(), F_SETFL, O_NONBLOCK);
  if (endpoint.tls) socket.use_tls();
  if (!socket.handshake_in_time()) give_up("the handshake of TLS with " + endpoint.authority() + " failed");
  return socket;
}

Socket begin_connect(const Endpoint& endpoint, std::size_t number) {
  Socket socket(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (!socket.open()) give_up(std::string("no more sockets (ulimit -n): ") + std::strerror(errno));
  const int on = 1;
  setsockopt(socket.get(), IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  if (number >= connections_per_source) {
    setsockopt(socket.get(), IPPROTO_IP, IP_BIND_ADDRESS_NO_PORT, &on, sizeof on);
    sockaddr_in source{};
    source.sin_family = AF_INET;
    source.sin_addr.s_addr = htonl(INADDR_LOOPBACK + static_cast<std::uint32_t>(number / connections_per_source));
    if (bind(socket.get(), plain(source), sizeof source) != 0) give_up(std::string("bind: ") + std::strerror(errno));
  }
  sockaddr_in address = endpoint.address;
  if (connect(socket.get(), plain(address), sizeof address) != 0 && errno != EINPROGRESS)
    give_up("cannot connect to " + endpoint.authority() + ": " + std::strerror(errno));
  if (endpoint.tls) socket.use_tls();
  return socket;
}

void send_all(const Socket& socket, std::string_view bytes) {
  if (!socket.send_all_in_time(bytes)) give_up(std::string("send: ") + std::strerror(errno));
}

Reply request(const Endpoint& endpoint, std::string_view method, std::string_view path, std::string_view body) {
  const Socket socket = connect_to(endpoint);
  std::string head(method);
  head.append(" ").append(path).append(" HTTP/1.1\r\nHost: ").append(endpoint.authority());
  head.append("\r\nConnection: close\r\n");
  if (!body.empty()) head.append("Content-Type: application/json\r\n");
  head.append("Content-Length: ").append(std::to_string(body.size())).append("\r\n\r\n").append(body);
  send_all(socket, head);
  std::string text;
  char buffer[16 * 1024];
  for (ssize_t size = 0; (size = socket.receive_in_time(buffer, sizeof buffer)) > 0;)
    text.append(buffer, static_cast<std::size_t>(size));
  Reply reply;
  if (text.size() > 12) std::from_chars(text.data() + 9, text.data() + 12, reply.status);
  if (reply.status == 0) give_up("no answer to " + std::string(method) + " " + std::string(path));
  const auto end = text.find("\r\n\r\n");
  if (end != std::string::npos) reply.body = text.substr(end + 4);
  return reply;
}

}  // namespace semblante::bench
