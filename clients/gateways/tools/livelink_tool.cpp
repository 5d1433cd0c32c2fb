// semblante-livelink: publishes the packets of the app Live Link Face to a stream.

#include <iostream>

#include <CLI/CLI.hpp>

#include "clients/gateways/livelink/receiver.h"
#include "clients/gateways/tools/inbound.h"

// Only a mistake in the options themselves, or a lack of memory, throws here: both may end the program.
int main(int argc, char** argv) {  // NOLINT(bugprone-exception-escape)
  using namespace semblante;
  gateways::InboundOptions options;
  options.program = "semblante-livelink";
  options.usual_port = "11111";
  std::string subject;

  CLI::App app{"Publishes the packets of the app Live Link Face (ARKit, UDP) to a stream of a Semblante server.",
               "semblante-livelink"};
  gateways::add_inbound_options(app, options);
  app.add_option("--subject", subject, "subject name of the device to follow; default: the first that sends a face");
  app.footer("Stops at SIGINT and SIGTERM, and then prints its counters.");
  CLI11_PARSE(app, argc, argv);

  livelink::Receiver receiver(subject);
  const Status done = gateways::run_inbound(options, [&receiver](std::span<const std::uint8_t> packet, double arrival) {
    auto taken = receiver.take(packet, arrival);
    if (!taken) return Result<std::optional<gateways::InboundFace>>(std::move(taken).error());
    std::optional<gateways::InboundFace> face;
    if (*taken) face = gateways::InboundFace{(*taken)->frame, (*taken)->seconds, (*taken)->clamped};
    return Result<std::optional<gateways::InboundFace>>(face);
  });
  std::cout << "packets of other subjects " << receiver.others() << ", without a face " << receiver.faceless()
            << std::endl;
  if (!done) {
    std::cerr << "semblante-livelink: " << done.error().where << ": " << done.error().message << '\n';
    return 1;
  }
  return 0;
}
