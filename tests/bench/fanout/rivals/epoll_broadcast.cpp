// The least that fan-out can cost: sockets, a prepared frame, send(). Nothing else that a server must do.
//   bench_fanout_epoll MESSAGES_PER_SECOND BYTES

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <unistd.h>
#include <vector>

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/epoll.h>
#include <sys/socket.h>
#include <sys/timerfd.h>

#include "tests/bench/fanout/rivals/rival.h"

namespace semblante::bench::rivals {
namespace {

enum class Peer : std::uint8_t { none, handshake, live };

class Broadcast {
 public:
  explicit Broadcast(const Arguments& arguments) : arguments_(arguments) {}

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
    announce(ntohs(address.sin_port));
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
    char buffer[4096];
    const ssize_t size = recv(descriptor, buffer, sizeof buffer, 0);
    if (size <= 0) {
      if (size < 0 && errno == EAGAIN) return;
      std::erase(live_, descriptor);
      peers_[static_cast<std::size_t>(descriptor)] = Peer::none;
      close(descriptor);
      return;
    }
    // The whole request comes in one piece on loopback, and it is always the same.
    if (peers_[static_cast<std::size_t>(descriptor)] != Peer::handshake) return;
    send(descriptor, upgrade_response.data(), upgrade_response.size(), MSG_NOSIGNAL);
    peers_[static_cast<std::size_t>(descriptor)] = Peer::live;
    live_.push_back(descriptor);
  }

  void accept_all() {
    for (int peer = 0; (peer = accept4(listener_, nullptr, nullptr, SOCK_NONBLOCK)) >= 0;) {
      const int on = 1;
      setsockopt(peer, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
      if (peers_.size() <= static_cast<std::size_t>(peer)) peers_.resize(static_cast<std::size_t>(peer) + 1);
      peers_[static_cast<std::size_t>(peer)] = Peer::handshake;
      watch(peer);
    }
  }

  void send_to_all() {
    const auto frame = server_frame(next_payload(arguments_, ++sequence_));
    for (const int peer : live_) send(peer, frame.data(), frame.size(), MSG_NOSIGNAL);
  }

  const Arguments arguments_;
  int epoll_ = -1, listener_ = -1, timer_ = -1;
  std::vector<Peer> peers_;
  std::vector<int> live_;
  std::uint64_t sequence_ = 0;
};

}  // namespace
}  // namespace semblante::bench::rivals

int main(int count, char** words) {
  using namespace semblante::bench::rivals;
  return Broadcast(arguments_of(count, words)).run();
}
