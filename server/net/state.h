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

/// Number of open connections by address. Any thread.
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

struct SharedState {
  SharedState(ServerConfig c, http::Application& a)
      : config(std::move(c)),
        application(a),
        io(static_cast<int>(config.io_threads)),
        live(static_cast<int>(config.io_threads)),
        workers(config.worker_threads) {}

  ServerConfig config;
  http::Application& application;
  boost::asio::io_context io;    ///< connections until they become WebSockets
  boost::asio::io_context live;  ///< WebSockets
  WorkerPool workers;
  AddressCounts addresses;
  std::atomic<bool> stopping{false};
  std::atomic<std::uint64_t> connections_open{0}, connections_total{0}, connections_refused{0}, requests_total{0},
      busy{0}, websockets_open{0}, upload_number{0};
  std::atomic<std::uint64_t> files_open{0};  ///< see BodyFile
};

/// Counts one open connection during its lifetime, and that of its address.
class ConnectionCount {
 public:
  explicit ConnectionCount(std::shared_ptr<SharedState> state, std::optional<http::AddressBytes> address = {})
      : state_(std::move(state)), address_(address) {
    ++state_->connections_open;
    ++state_->connections_total;
    if (address_) state_->addresses.add(*address_);
  }
  ~ConnectionCount() {
    if (!state_) return;
    --state_->connections_open;
    if (address_) state_->addresses.remove(*address_);
  }
  ConnectionCount(ConnectionCount&&) noexcept = default;
  ConnectionCount(const ConnectionCount&) = delete;
  ConnectionCount& operator=(const ConnectionCount&) = delete;
  ConnectionCount& operator=(ConnectionCount&&) = delete;

 private:
  std::shared_ptr<SharedState> state_;
  std::optional<http::AddressBytes> address_;
};

}  // namespace semblante::net
