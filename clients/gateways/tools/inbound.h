#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>

#include "clients/native/client/stream_publisher.h"
#include "core/kernel/semblante_kernel.h"
#include "core/types/result.h"

namespace CLI {
class App;
}

namespace semblante::gateways {

/// A face completed by a packet.
struct InboundFace {
  semblante_frame frame{};
  std::optional<double> seconds;  ///< of the sender's clock
  std::size_t clamped = 0;        ///< values outside 0..1
};

/// One packet; `arrival` in seconds of a monotonic clock. Errors: an invalid packet.
using Decode = std::function<Result<std::optional<InboundFace>>(std::span<const std::uint8_t> packet, double arrival)>;

struct InboundOptions {
  std::string program;
  client::ServerOptions server;
  std::string stream;
  std::string listen = "127.0.0.1";
  std::string usual_port;
  double max_packets = 2000;  ///< a second
  double max_fps = 120;
  client::PublisherOptions publisher;
};

void add_inbound_options(CLI::App& app, InboundOptions& options);

/// UDP in, stream out, until SIGINT or SIGTERM; prints its address at the start and the counts at the end. Errors:
/// cannot listen, or the server has no such stream.
Status run_inbound(const InboundOptions& options, const Decode& decode);

}  // namespace semblante::gateways
