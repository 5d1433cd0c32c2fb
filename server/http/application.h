#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <variant>

#include "server/http/message.h"
#include "server/http/problem.h"
#include "server/http/websocket_peer.h"

namespace semblante::http {

/// How to handle a request whose header has arrived: the limits of its body, and where it is handled.
struct BodyPlan {
  std::uint64_t max_bytes = 0;  ///< a larger body gets 413
  bool to_file = false;         ///< written to a temporary file while it arrives, instead of memory
  bool required = false;        ///< neither Content-Length nor chunked: 411
  bool immediate = false;       ///< handle() runs on the connection's strand, not on a worker: it must not block
  std::optional<Advice> if_too_large = std::nullopt;  ///< of the 413
  std::shared_ptr<const void> held = nullptr;         ///< kept until the request has been answered
};

/// The interface that the network layer (net/) calls. One object serves all connections.
class Application {
 public:
  virtual ~Application() = default;
  /// On the connection's strand, when the header has arrived, before all calls below: sets the request's route. Must
  /// not block.
  virtual void find_route(Request& /*head*/) {}
  /// On the connection's strand, when the header has arrived and the body has not: must not block. An answer here
  /// refuses the request without reading its body.
  virtual std::variant<BodyPlan, Response> plan(const Request& head) = 0;
  /// With the body, on a worker thread: may block, unless the plan was `immediate`.
  virtual Response handle(Request& request) = 0;
  /// On the connection's strand, for a WebSocket upgrade: must not block.
  virtual std::variant<std::shared_ptr<WebSocketPeer>, Response> open_websocket(const Request& head) = 0;
  /// The answer to a request whose body could not be written, by errno. On any thread: must not block.
  virtual Problem unwritten_body(int error_number) {
    return make_problem("internal", "the body cannot be written: error " + std::to_string(error_number));
  }
  /// Adds the headers of every answer (CORS). On any thread.
  virtual void decorate(const Request& head, Response& response) = 0;
};

}  // namespace semblante::http
