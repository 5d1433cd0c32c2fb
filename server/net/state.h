#pragma once

// Private to net/: the state shared by the listener and its sessions. Beast itself is used only in the two session
// sources.

#include <atomic>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>

#include "server/net/server.h"
#include "server/net/worker_pool.h"

namespace semblante::net {

/// Number of open connections, or of something else, by address. Any thread.
class AddressCounts {
 public:
  [[nodiscard]] std::uint32_t of(const http::AddressBytes& address) const {
    const std::lock_guard lock(mutex_);
    const auto found = counts_.find(address);
    return found == counts_.end() ? 0 : found->second;
  }
  void add(const http::AddressBytes& address) {
    const std::lock_guard lock(mutex_);
    ++counts_[address];
  }
  void remove(const http::AddressBytes& address) {
    const std::lock_guard lock(mutex_);
    const auto found = counts_.find(address);
    if (--found->second == 0) counts_.erase(found);
  }

 private:
  mutable std::mutex mutex_;
  std::map<http::AddressBytes, std::uint32_t> counts_;
};

/// An io_context whose pending operations can be destroyed before it is: they own connections, and these own the state
/// that owns the context.
class Context : public boost::asio::io_context {
 public:
  using io_context::io_context;
  /// After its threads have ended. Nothing that is posted later runs.
  void drop_pending() { shutdown(); }
};

struct SharedState {
  SharedState(ServerConfig c, http::Application& a)
      : config(std::move(c)),
        application(a),
        front(1),
        io(static_cast<int>(config.io_threads)),
        live(static_cast<int>(config.io_threads)),
        workers(config.worker_threads) {}

  ServerConfig config;
  http::Application& application;
  Context front;  ///< listeners with TLS, and handshakes
  Context io;     ///< connections after that, until they become WebSockets
  Context live;   ///< WebSockets
  WorkerPool workers;
  AddressCounts addresses;   ///< of connections
  AddressCounts handshakes;  ///< of those whose handshake of TLS is not done
  std::atomic<bool> stopping{false};
  std::atomic<std::uint64_t> connections_open{0}, connections_total{0}, connections_refused{0}, requests_total{0},
      busy{0}, websockets_open{0}, upload_number{0};
  std::atomic<std::uint64_t> files_open{0};  ///< see BodyFile
};

/// Counts one open connection during its lifetime, and that of its address; also its handshake of TLS, until it is
/// done.
class ConnectionCount {
 public:
  explicit ConnectionCount(std::shared_ptr<SharedState> state, std::optional<http::AddressBytes> address = {},
                           bool with_tls = false)
      : state_(std::move(state)), address_(address), in_handshake_(with_tls && address) {
    ++state_->connections_open;
    ++state_->connections_total;
    if (address_) state_->addresses.add(*address_);
    if (in_handshake_) state_->handshakes.add(*address_);
  }
  ~ConnectionCount() {
    if (!state_) return;
    handshake_done();
    --state_->connections_open;
    if (address_) state_->addresses.remove(*address_);
  }
  ConnectionCount(ConnectionCount&&) noexcept = default;
  ConnectionCount(const ConnectionCount&) = delete;
  ConnectionCount& operator=(const ConnectionCount&) = delete;
  ConnectionCount& operator=(ConnectionCount&&) = delete;

  void handshake_done() {
    if (std::exchange(in_handshake_, false)) state_->handshakes.remove(*address_);
  }

 private:
  std::shared_ptr<SharedState> state_;
  std::optional<http::AddressBytes> address_;
  bool in_handshake_;
};

}  // namespace semblante::net
