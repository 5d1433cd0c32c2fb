#include "tests/support/tcp_proxy.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <deque>
#include <fcntl.h>
#include <list>
#include <mutex>
#include <poll.h>
#include <random>
#include <thread>
#include <unistd.h>
#include <utility>
#include <vector>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/eventfd.h>
#include <sys/socket.h>

namespace semblante::testing {
namespace {

using Clock = std::chrono::steady_clock;

/// More than this on the way, and no more is read.
constexpr std::size_t most_on_the_way = std::size_t{1} << 20U;

Clock::duration milliseconds(double ms) {
  return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double, std::milli>(ms));
}

/// Ends it with a reset, not a polite end.
void reset(int socket) {
  const linger at_once{1, 0};
  setsockopt(socket, SOL_SOCKET, SO_LINGER, &at_once, sizeof(at_once));
  close(socket);
}

void set_up(int socket) {
  const int yes = 1;
  setsockopt(socket, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof(yes));
  fcntl(socket, F_SETFL, fcntl(socket, F_GETFL) | O_NONBLOCK);
}

/// Bytes on their way from one socket to the other.
struct Way {
  struct Piece {
    Clock::time_point due;
    std::string bytes;
  };
  std::deque<Piece> pieces;
  std::size_t size = 0;
  Clock::time_point last_due{}, free_at{};
  bool ended = false;   ///< nothing more comes
  bool passed = false;  ///< and that was told to the other side
  bool blocked = false;
};

struct Connection {
  int client = -1, server = -1;
  Way up, down;
  Clock::time_point cut_at = Clock::time_point::max();
  bool dead = false;
};

}  // namespace

struct TcpProxy::Impl {
  ProxyOptions options;
  int listener = -1, wake = -1;
  std::uint16_t port = 0;
  std::mt19937_64 random;
  std::list<Connection> connections;

  std::mutex mutex;  ///< guards what follows
  bool stopping = false, cut_all = false, refusing = false;
  std::optional<std::size_t> bytes_to_cut;
  ProxyCounts counts;
  std::thread thread;

  explicit Impl(ProxyOptions wanted) : options(std::move(wanted)), random(options.seed) {
    listener = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof(address);
    wake = eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
    if (listener < 0 || wake < 0 || bind(listener, reinterpret_cast<sockaddr*>(&address), size) != 0 ||
        listen(listener, 64) != 0 || getsockname(listener, reinterpret_cast<sockaddr*>(&address), &size) != 0)
      std::abort();
    port = ntohs(address.sin_port);
    thread = std::thread([this] { run(); });
  }

  ~Impl() {
    tell([this] { stopping = true; });
    thread.join();
    for (Connection& each : connections) kill(each);
    close(listener);
    close(wake);
  }

  template <class Change>
  void tell(Change change) {
    {
      const std::lock_guard lock(mutex);
      change();
    }
    const std::uint64_t one = 1;
    static_cast<void>(!write(wake, &one, sizeof(one)));
  }

  double uniform(double high) { return std::uniform_real_distribution<double>(0, high)(random); }

  static void kill(Connection& connection) {
    if (connection.dead) return;
    connection.dead = true;
    reset(connection.client);
    reset(connection.server);
  }

  void accept_all() {
    while (true) {
      const int client = accept4(listener, nullptr, nullptr, SOCK_CLOEXEC);
      if (client < 0) return;
      bool refuse = false;
      {
        const std::lock_guard lock(mutex);
        refuse = refusing;
        ++counts.connections;
      }
      sockaddr_in address{};
      address.sin_family = AF_INET;
      address.sin_port = htons(options.target_port);
      inet_pton(AF_INET, options.target_host.c_str(), &address.sin_addr);
      const int server = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
      // Loopback: this is at once, or refused.
      if (refuse || server < 0 || connect(server, reinterpret_cast<sockaddr*>(&address), sizeof(address)) != 0) {
        reset(client);
        if (server >= 0) close(server);
        continue;
      }
      set_up(client);
      set_up(server);
      Connection& connection = connections.emplace_back();
      connection.client = client;
      connection.server = server;
      if (options.cut_every > 0) {
        const double pause = -std::log(1 - uniform(0.999)) * options.cut_every * 1000;
        connection.cut_at = Clock::now() + milliseconds(pause);
      }
    }
  }

  void read_from(int socket, Way& way) {
    std::array<char, 16384> buffer{};
    const ssize_t size = read(socket, buffer.data(), buffer.size());
    if (size < 0 && (errno == EAGAIN || errno == EINTR)) return;
    const auto now = Clock::now();
    double ms = options.delay + (options.jitter > 0 ? uniform(options.jitter) : 0);
    if (options.stalls > 0 && uniform(1) < options.stalls) ms += options.stall;
    way.last_due = std::max(way.last_due, now + milliseconds(ms));
    if (size <= 0) {
      way.ended = true;
      return;
    }
    if (options.bandwidth > 0) {
      way.free_at = std::max(way.free_at, now) + milliseconds(1000.0 * static_cast<double>(size) / options.bandwidth);
      way.last_due = std::max(way.last_due, way.free_at + milliseconds(options.delay));
    }
    way.pieces.push_back({way.last_due, std::string(buffer.data(), static_cast<std::size_t>(size))});
    way.size += static_cast<std::size_t>(size);
  }

  /// Sends what is due. False when the other side is gone, or it is to be cut.
  bool write_to(int socket, Way& way, bool down) {
    const auto now = Clock::now();
    way.blocked = false;
    while (!way.pieces.empty() && way.pieces.front().due <= now) {
      Way::Piece& piece = way.pieces.front();
      std::size_t allowed = piece.bytes.size();
      const std::lock_guard lock(mutex);
      if (down && bytes_to_cut) allowed = std::min(allowed, *bytes_to_cut);
      const ssize_t sent = allowed == 0 ? 0 : send(socket, piece.bytes.data(), allowed, MSG_NOSIGNAL);
      if (sent < 0) {
        way.blocked = errno == EAGAIN;
        return way.blocked || errno == EINTR;
      }
      const auto count = static_cast<std::size_t>(sent);
      counts.worst_lateness =
          std::max(counts.worst_lateness, std::chrono::duration<double, std::milli>(Clock::now() - piece.due).count());
      (down ? counts.bytes_down : counts.bytes_up) += count;
      way.size -= count;
      piece.bytes.erase(0, count);
      if (piece.bytes.empty()) way.pieces.pop_front();
      if (down && bytes_to_cut) {
        *bytes_to_cut -= count;
        if (*bytes_to_cut == 0) {
          bytes_to_cut.reset();
          ++counts.cuts;
          return false;
        }
      }
    }
    if (way.ended && way.pieces.empty() && !way.passed && way.last_due <= now) {
      way.passed = true;
      shutdown(socket, SHUT_WR);
    }
    return true;
  }

  void run() {
    std::vector<pollfd> entries;
    while (true) {
      {
        const std::lock_guard lock(mutex);
        if (stopping) return;
        if (cut_all) {
          for (Connection& each : connections) kill(each);
          ++counts.cuts;
          cut_all = false;
        }
      }
      auto next = Clock::now() + std::chrono::seconds(1);
      entries = {{listener, POLLIN, 0}, {wake, POLLIN, 0}};
      std::erase_if(connections, [](const Connection& each) { return each.dead; });
      for (const Connection& each : connections) {
        const auto events = [&](const Way& in, const Way& out) {
          const int wanted = (in.ended || in.size > most_on_the_way ? 0 : POLLIN) | (out.blocked ? POLLOUT : 0);
          return static_cast<short>(wanted);
        };
        entries.push_back({each.client, events(each.up, each.down), 0});
        entries.push_back({each.server, events(each.down, each.up), 0});
        for (const Way* way : {&each.up, &each.down}) {
          if (!way->blocked && !way->pieces.empty()) next = std::min(next, way->pieces.front().due);
          if (way->ended && !way->passed) next = std::min(next, way->last_due);
        }
        next = std::min(next, each.cut_at);
      }
      const auto wait = std::max(next - Clock::now(), Clock::duration::zero());
      const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(wait);
      const timespec timeout{seconds.count(), (wait - seconds).count()};
      ppoll(entries.data(), entries.size(), &timeout, nullptr);
      std::uint64_t ignored = 0;
      static_cast<void>(!read(wake, &ignored, sizeof(ignored)));
      std::size_t i = 2;
      for (Connection& each : connections) {
        if ((entries[i].revents & (POLLIN | POLLHUP | POLLERR)) != 0 && !each.up.ended) read_from(each.client, each.up);
        if ((entries[i + 1].revents & (POLLIN | POLLHUP | POLLERR)) != 0 && !each.down.ended)
          read_from(each.server, each.down);
        i += 2;
        const bool both = write_to(each.client, each.down, true) && write_to(each.server, each.up, false);
        const bool over = each.up.passed && each.down.passed;
        const bool cut = Clock::now() >= each.cut_at;
        if (cut) {
          const std::lock_guard lock(mutex);
          ++counts.cuts;
        }
        if (!both || over || cut) kill(each);
      }
      if (entries[0].revents != 0) accept_all();
    }
  }
};

TcpProxy::TcpProxy(ProxyOptions options) : impl_(std::make_unique<Impl>(std::move(options))) {}
TcpProxy::~TcpProxy() = default;

std::uint16_t TcpProxy::port() const { return impl_->port; }

ProxyCounts TcpProxy::counts() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->counts;
}

void TcpProxy::cut() {
  impl_->tell([this] { impl_->cut_all = true; });
}

void TcpProxy::cut_after(std::size_t bytes_down) {
  impl_->tell([&] { impl_->bytes_to_cut = std::max<std::size_t>(bytes_down, 1); });
}

void TcpProxy::refuse(bool yes) {
  impl_->tell([&] { impl_->refusing = yes; });
}

}  // namespace semblante::testing
