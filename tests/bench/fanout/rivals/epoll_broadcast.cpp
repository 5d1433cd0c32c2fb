// The least that fan-out can cost: sockets, a prepared frame, send() or SSL_write(). Nothing else that a server must
// do.
//   bench_fanout_epoll MESSAGES_PER_SECOND BYTES [CERTIFICATE KEY]

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <unistd.h>
#include <vector>

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <openssl/err.h>
#include <openssl/ssl.h>
#include <sys/epoll.h>
#include <sys/socket.h>
#include <sys/timerfd.h>

#include "tests/bench/fanout/rivals/rival.h"

namespace semblante::bench::rivals {
namespace {

enum class State : std::uint8_t { none, securing, upgrading, live };

struct Peer {
  State state = State::none;
  SSL* tls = nullptr;
};

/// As a server has it: TLS 1.2 or later, memory only where bytes wait, the kernel's encryption where there is one.
SSL_CTX* make_context(const Arguments& arguments) {
  SSL_CTX* context = SSL_CTX_new(TLS_server_method());
  SSL_CTX_set_mode(context, SSL_MODE_RELEASE_BUFFERS);
  SSL_CTX_set_options(context, SSL_OP_ENABLE_KTLS);
  if (SSL_CTX_use_certificate_chain_file(context, arguments.certificate) != 1 ||
      SSL_CTX_use_PrivateKey_file(context, arguments.key, SSL_FILETYPE_PEM) != 1)
    std::exit(2);
  return context;
}

class Broadcast {
 public:
  explicit Broadcast(const Arguments& arguments)
      : arguments_(arguments), context_(arguments.certificate != nullptr ? make_context(arguments) : nullptr) {}

  int run() {
    epoll_ = epoll_create1(0);
    listener_ = socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    if (bind(listener_, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0 || listen(listener_, 4096) != 0 ||
        getsockname(listener_, reinterpret_cast<sockaddr*>(&address), &size) != 0)
      return 1;
    timer_ = timerfd_create(CLOCK_MONOTONIC, TFD_NONBLOCK);
    const auto interval = static_cast<long>(1e9 / arguments_.messages_per_second);
    const itimerspec every{{interval / 1'000'000'000, interval % 1'000'000'000},
                           {interval / 1'000'000'000, interval % 1'000'000'000}};
    timerfd_settime(timer_, 0, &every, nullptr);
    watch(listener_);
    watch(timer_);
    announce(ntohs(address.sin_port), context_ != nullptr ? "https" : "http");
    epoll_event events[256];
    while (true) {
      const int count = epoll_wait(epoll_, events, 256, -1);
      for (int i = 0; i < count; ++i) ready(events[i].data.fd);
    }
  }

 private:
  void watch(int descriptor) const {
    epoll_event event{};
    event.events = EPOLLIN;
    event.data.fd = descriptor;
    epoll_ctl(epoll_, EPOLL_CTL_ADD, descriptor, &event);
  }

  void ready(int descriptor) {
    if (descriptor == listener_) return accept_all();
    if (descriptor == timer_) {
      std::uint64_t ticks = 0;
      if (read(timer_, &ticks, sizeof ticks) != sizeof ticks) return;
      for (; ticks > 0; --ticks) send_to_all();
      return;
    }
    Peer& peer = peers_[static_cast<std::size_t>(descriptor)];
    if (peer.state == State::securing) {
      ERR_clear_error();
      const int result = SSL_do_handshake(peer.tls);
      if (result == 1)
        peer.state = State::upgrading;
      else if (SSL_get_error(peer.tls, result) != SSL_ERROR_WANT_READ)
        return drop(descriptor);
      if (result != 1) return;
    }
    char buffer[4096];
    ERR_clear_error();
    const auto size = peer.tls != nullptr ? SSL_read(peer.tls, buffer, sizeof buffer)
                                          : static_cast<int>(recv(descriptor, buffer, sizeof buffer, 0));
    if (size <= 0) {
      const bool nothing =
          peer.tls != nullptr ? SSL_get_error(peer.tls, size) == SSL_ERROR_WANT_READ : size < 0 && errno == EAGAIN;
      if (!nothing) drop(descriptor);
      return;
    }
    // The whole request comes in one piece on loopback, and it is always the same.
    if (peer.state != State::upgrading) return;
    send_one(peer, descriptor, upgrade_response);
    peer.state = State::live;
    live_.push_back(descriptor);
  }

  void drop(int descriptor) {
    std::erase(live_, descriptor);
    Peer& peer = peers_[static_cast<std::size_t>(descriptor)];
    SSL_free(peer.tls);
    peer = {};
    close(descriptor);
  }

  void accept_all() {
    for (int peer = 0; (peer = accept4(listener_, nullptr, nullptr, SOCK_NONBLOCK)) >= 0;) {
      const int on = 1;
      setsockopt(peer, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
      if (peers_.size() <= static_cast<std::size_t>(peer)) peers_.resize(static_cast<std::size_t>(peer) + 1);
      Peer made{context_ != nullptr ? State::securing : State::upgrading, nullptr};
      if (context_ != nullptr) {
        made.tls = SSL_new(context_);
        SSL_set_fd(made.tls, peer);
        SSL_set_accept_state(made.tls);
      }
      peers_[static_cast<std::size_t>(peer)] = made;
      watch(peer);
    }
  }

  void send_to_all() {
    const auto frame = server_frame(next_payload(arguments_, ++sequence_));
    for (const int peer : live_) send_one(peers_[static_cast<std::size_t>(peer)], peer, frame);
  }

  static void send_one(const Peer& peer, int descriptor, std::string_view bytes) {
    if (peer.tls != nullptr)
      SSL_write(peer.tls, bytes.data(), static_cast<int>(bytes.size()));
    else
      send(descriptor, bytes.data(), bytes.size(), MSG_NOSIGNAL);
  }

  const Arguments arguments_;
  SSL_CTX* const context_;  ///< null: without TLS
  int epoll_ = -1, listener_ = -1, timer_ = -1;
  std::vector<Peer> peers_;
  std::vector<int> live_;
  std::uint64_t sequence_ = 0;
};

}  // namespace
}  // namespace semblante::bench::rivals

int main(int count, char** words) {
  using namespace semblante::bench::rivals;
  std::signal(SIGPIPE, SIG_IGN);
  return Broadcast(arguments_of(count, words)).run();
}
