#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <variant>

#include "server/http/message.h"
#include "server/http/problem.h"
#include "server/http/websocket_peer.h"

namespace semblante::http {

/// What to do with a request whose header has arrived: what its body may be, and where it is handled.
struct BodyPlan {
  std::uint64_t max_bytes = 0;  ///< more is answered 413
  bool to_file = false;         ///< written to a temporary file while it arrives, instead of memory
  bool required = false;        ///< no Content-Length and not chunked is answered 411
  bool immediate = false;       ///< handle() runs on the connection's strand, not on a worker: it must not block
};

/// What the network layer (net/) asks of the layers above. One object serves all connections.
class Application {
 public:
  virtual ~Application() = default;
  /// On the connection's strand, as soon as the header is there, before everything below: writes into the request which
  /// of the application's routes it is for. Must not block.
  virtual void find_route(Request& /*head*/) {}
  /// On the connection's strand, when the header is there and the body is not: must not block. An answer here refuses
  /// the request without reading its body.
  virtual std::variant<BodyPlan, Response> plan(const Request& head) = 0;
  /// With the body, on a worker thread: may take its time, unless the plan was `immediate`.
  virtual Response handle(Request& request) = 0;
  /// On the connection's strand, for a request that asks for a WebSocket: must not block.
  virtual std::variant<std::shared_ptr<WebSocketPeer>, Response> open_websocket(const Request& head) = 0;
  /// The answer to a request whose body the disk did not take, by errno. On any thread: must not block.
  virtual Problem unwritten_body(int error_number) {
    return make_problem("internal", "the body cannot be written: error " + std::to_string(error_number));
  }
  /// Adds what every answer carries (CORS). On any thread.
  virtual void decorate(const Request& head, Response& response) = 0;
};

}  // namespace semblante::http
