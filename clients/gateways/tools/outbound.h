#pragma once

#include <string>

#include "clients/gateways/vmc/sender.h"
#include "core/types/result.h"
#include "protocol/http/server_address.h"

namespace semblante::gateways {

struct OutboundOptions {
  std::string program;
  client::ServerOptions server;
  std::string stream;
  std::string to = "127.0.0.1";
  std::string usual_port;
  bool anywhere = false;  ///< also allow other machines
  vmc::SenderOptions sender;
};

/// Follows a stream and sends its faces by VMC until SIGINT or SIGTERM. Reconnects when the connection is lost, and
/// prints its counters at the end. An unchanged face is repeated four times per second, because UDP loses packets and
/// receivers expect packets continuously. Errors: cannot send, or the server has no such stream.
Status run_outbound(const OutboundOptions& options);

}  // namespace semblante::gateways
