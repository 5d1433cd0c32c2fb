#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace semblante::testing {

/// What a network does to the bytes of one direction. Nothing comes out of order: what is late holds what follows.
struct ProxyOptions {
  std::string target_host = "127.0.0.1";
  std::uint16_t target_port = 0;
  double delay = 0;        ///< ms, each way
  double jitter = 0;       ///< ms, evenly from 0 to this on top, of every piece that is read
  double bandwidth = 0;    ///< bytes a second each way; 0: without limit
  double stalls = 0;       ///< share of the pieces that have to be sent again
  double stall = 300;      ///< ms that this takes
  double cut_every = 0;    ///< seconds, on average, after which a connection is cut; 0: on command only
  std::uint64_t seed = 1;  ///< of all chance
};

struct ProxyCounts {
  std::uint64_t connections = 0, cuts = 0, bytes_down = 0, bytes_up = 0;
  /// How late the proxy itself sent what was due, ms: what a busy machine adds to the network that is meant.
  double worst_lateness = 0;
};

/// A TCP proxy on a free loopback port whose connections can be slow, uneven, and cut. Runs in a thread of its own.
class TcpProxy {
 public:
  explicit TcpProxy(ProxyOptions options);
  ~TcpProxy();
  TcpProxy(const TcpProxy&) = delete;
  TcpProxy& operator=(const TcpProxy&) = delete;

  [[nodiscard]] std::uint16_t port() const;
  [[nodiscard]] ProxyCounts counts() const;
  /// Resets all connections (RST), with what is on the way in them.
  void cut();
  /// Resets the connection that has carried so many bytes more to the client, counted over all connections together,
  /// those that are made later too. In the middle of a message, if it is there.
  void cut_after(std::size_t bytes_down);
  /// While true new connections are reset at once.
  void refuse(bool yes);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace semblante::testing
