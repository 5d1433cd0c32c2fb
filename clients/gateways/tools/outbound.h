#pragma once

#include <string>

#include "clients/gateways/vmc/sender.h"
#include "core/types/result.h"

namespace semblante::gateways {

struct OutboundOptions {
  std::string program;
  std::string server = "http://127.0.0.1:8080";
  std::string stream;
  std::string to = "127.0.0.1";
  std::string usual_port;
  bool anywhere = false;  ///< not to this machine alone
  vmc::SenderOptions sender;
};

/// Stream in, VMC out, until SIGINT or SIGTERM; connects again when the connection is lost, prints the counts last. A
/// face that does not change is said four times a second, since UDP loses packets and receivers wait for some. Errors:
/// it cannot send there, or the server has no such stream.
Status run_outbound(const OutboundOptions& options);

}  // namespace semblante::gateways
