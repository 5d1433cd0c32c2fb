#pragma once

// Private to net/: the state shared by the listener and its sessions. Beast itself is used only in the two session
// sources.

#include <atomic>
#include <memory>
#include <utility>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>

#include "server/net/server.h"
#include "server/net/worker_pool.h"

namespace semblante::net {

struct SharedState {
  SharedState(ServerConfig c, http::Application& a)
      : config(std::move(c)), application(a), io(static_cast<int>(config.io_threads)), workers(config.worker_threads) {}

  ServerConfig config;
  http::Application& application;
  boost::asio::io_context io;
  WorkerPool workers;
  std::atomic<bool> stopping{false};
  std::atomic<std::uint64_t> connections_open{0}, connections_total{0}, connections_refused{0}, requests_total{0},
      busy{0}, websockets_open{0}, upload_number{0};
};

/// Counts one open connection during its lifetime.
class ConnectionCount {
 public:
  explicit ConnectionCount(std::shared_ptr<SharedState> state) : state_(std::move(state)) {
    ++state_->connections_open;
    ++state_->connections_total;
  }
  ~ConnectionCount() {
    if (state_) --state_->connections_open;
  }
  ConnectionCount(ConnectionCount&&) noexcept = default;
  ConnectionCount(const ConnectionCount&) = delete;
  ConnectionCount& operator=(const ConnectionCount&) = delete;
  ConnectionCount& operator=(ConnectionCount&&) = delete;

 private:
  std::shared_ptr<SharedState> state_;
};

}  // namespace semblante::net
