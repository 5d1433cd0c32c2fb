#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "core/types/result.h"
#include "server/http/application.h"

namespace semblante::net {

/// Each limit guards one read or one count; server/README.md lists what a client sees at each limit.
struct ServerLimits {
  std::uint32_t max_connections = 1024;
  std::uint32_t max_header_bytes = 16 * 1024;  ///< also of the trailers, of the line before a chunk, of all chunk
                                               ///< extensions of a body, and of the unparsed bytes of a connection
  std::uint32_t max_header_fields = 128;       ///< and as many query parameters
  std::chrono::seconds idle_timeout{60};       ///< between requests; a WebSocket is pinged at half of it
  std::chrono::seconds header_timeout{10};     ///< from the first byte of a request to the end of its header
  std::chrono::seconds read_timeout{30};       ///< between two pieces of a body
  std::chrono::seconds write_timeout{30};      ///< between two pieces of an answer
  std::chrono::seconds shutdown_grace{3};      ///< for pending answers at a shutdown
};

struct ServerConfig {
  std::string address = "127.0.0.1";
  std::uint16_t port = 8080;  ///< 0: any free port
  unsigned io_threads = 1;
  unsigned worker_threads = 2;
  std::filesystem::path upload_directory;  ///< for bodies on disk; must exist
  ServerLimits limits;
};

/// Counts for /metrics. Any thread.
struct ServerCounts {
  std::uint64_t connections_open = 0, connections_total = 0, connections_refused = 0, requests_total = 0,
                websockets_open = 0;
};

/// HTTP/1.1 and WebSocket on one port. Owns its I/O and worker threads; the application must outlive it.
class Server {
 public:
  Server(ServerConfig config, http::Application& application);
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  /// Binds and listens; returns the port. An error names the address and the reason (in use, no permission).
  Result<std::uint16_t> listen();
  /// Serves until stop(); then completes pending answers within the grace period, and returns. `on_stopping` is called
  /// once before the grace period begins, so that feeds can be ended.
  void run(const std::function<void()>& on_stopping);
  /// Any thread.
  void stop();
  /// SIGINT and SIGTERM call stop() while run() runs.
  void stop_on_signals();

  [[nodiscard]] ServerCounts counts() const;

 private:
  struct State;
  std::shared_ptr<State> state_;
};

}  // namespace semblante::net
