#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/types/result.h"
#include "server/http/address_range.h"
#include "server/http/application.h"
#include "server/net/tls_context.h"

namespace semblante::net {

/// Each limit guards one read or one count; server/README.md lists what a client sees at each limit.
struct ServerLimits {
  std::uint32_t max_connections = 1024;
  /// Of one IP address; addresses of this machine and those of ServerConfig::proxies have no such limit.
  std::uint32_t max_connections_per_address = 512;
  /// Of one address likewise: connections whose handshake of TLS has begun and is not done.
  std::uint32_t max_handshakes_per_address = 64;
  std::uint32_t max_files = 256;               ///< of bodies that are received or sent, open beside the connections
  std::uint32_t max_header_bytes = 16 * 1024;  ///< also of the trailers, of the line before a chunk, of all chunk
                                               ///< extensions of a body, and of the unparsed bytes of a connection
  /// Of a chunked body, for each byte of its content, beside as many as a header has: "1\r\n" before a byte, "\r\n"
  /// after it. No honest chunk needs more.
  static constexpr std::uint32_t framing_per_byte = 5;
  std::uint32_t max_header_fields = 128;    ///< and as many query parameters
  std::chrono::seconds idle_timeout{60};    ///< between requests; a WebSocket is pinged at half of it
  std::chrono::seconds header_timeout{10};  ///< from the first byte of a request to the end of its header, and for
                                            ///< the handshake of TLS
  double controls_per_second = 100;         ///< pings and pongs that one WebSocket sends, on average
  double controls_burst = 1000;
  std::uint32_t max_fragments = 1024;  ///< of one message of a WebSocket
  double fragments_per_second = 1000;  ///< of one WebSocket, on average, without the last ones of messages
  double fragments_burst = 2000;
  std::chrono::seconds read_timeout{30};  ///< between two pieces of a body
  std::chrono::seconds body_grace{30};    ///< for a whole body, in addition to the time of the least rate
  std::uint32_t least_body_rate = 1024;   ///< bytes per second, of a body that arrives and of a file that is sent

  /// The time that a body, or a message of a WebSocket, may take of which so many bytes have passed.
  [[nodiscard]] std::chrono::seconds body_time(std::uint64_t bytes) const {
    return body_grace + std::chrono::seconds(bytes / least_body_rate);
  }
  /// What is left of it for one that has begun then.
  [[nodiscard]] std::chrono::steady_clock::duration body_time_left(std::chrono::steady_clock::time_point begin,
                                                                   std::uint64_t bytes) const {
    return begin + body_time(bytes) - std::chrono::steady_clock::now();
  }
  std::chrono::seconds write_timeout{30};  ///< between two pieces of an answer
  std::chrono::seconds drain_time{10};     ///< for pending answers and waiting messages at a shutdown
};

/// An address to listen on.
struct Listener {
  std::string address = "127.0.0.1";
  std::uint16_t port = 8080;  ///< 0: any free port
  bool tls = false;           ///< with the context of set_tls()
};

struct ServerConfig {
  std::vector<Listener> listeners{Listener{}};
  std::vector<http::AddressRange> proxies;  ///< their connections are those of many clients
  unsigned io_threads = 1;                  ///< for requests, and as many for WebSockets
  unsigned worker_threads = 2;
  std::filesystem::path upload_directory;  ///< for bodies on disk; must exist
  ServerLimits limits;
};

/// Counts for /metrics. Any thread.
struct ServerCounts {
  std::uint64_t connections_open = 0, connections_total = 0, connections_refused = 0, requests_total = 0,
                websockets_open = 0;
};

/// HTTP/1.1 and WebSocket on one or more ports, with TLS or without. Owns its I/O and worker threads; the application
/// must outlive it.
class Server {
 public:
  Server(ServerConfig config, http::Application& application);
  /// Closes the connections that are left; WebSockets are told that they are disconnected.
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  /// Binds and listens; returns the ports, in the order of the listeners. An error names the address and the reason (in
  /// use, no permission).
  Result<std::vector<std::uint16_t>> listen();
  /// Any thread. Connections accepted from now on use this context; earlier ones keep theirs. Required before run() if
  /// a listener has TLS.
  void set_tls(std::shared_ptr<const TlsContext> context);
  /// Serves until stop(); then accepts no more connections, completes pending answers, sends WebSockets what waits for
  /// them, and returns: when all is done, at the latest after the drain time. `on_stopping` is called once before that,
  /// so that feeds and streams can be ended.
  void run(const std::function<void()>& on_stopping);
  /// Any thread.
  void stop();
  /// SIGINT and SIGTERM call stop() while run() runs; the second one ends the process at once. With `at_hangup` SIGHUP,
  /// which a closed terminal sends, calls stop() too, unless it is ignored, as nohup does.
  void stop_on_signals(bool at_hangup);
  /// SIGHUP calls `reload` on a worker thread while run() runs.
  void reload_on_signal(const std::function<void()>& reload);

  [[nodiscard]] ServerCounts counts() const;

 private:
  struct State;
  std::shared_ptr<State> state_;
};

}  // namespace semblante::net
