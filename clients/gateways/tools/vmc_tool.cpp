// semblante-vmc: the VMC protocol (OSC over UDP) into a stream, or a stream out to VMC.

#include <iostream>

#include <CLI/CLI.hpp>

#include "clients/gateways/tools/inbound.h"
#include "clients/gateways/tools/outbound.h"
#include "clients/gateways/vmc/receiver.h"

namespace {

using namespace semblante;

/// The default port of a marionette, the receiver of motion.
constexpr const char* marionette_port = "39539";

Status receive(const gateways::InboundOptions& options) {
  vmc::Receiver receiver;
  return gateways::run_inbound(options, [&receiver](std::span<const std::uint8_t> packet, double arrival) {
    auto taken = receiver.take(packet, arrival);
    if (!taken) return Result<std::optional<gateways::InboundFace>>(std::move(taken).error());
    std::optional<gateways::InboundFace> face;
    if (*taken) face = gateways::InboundFace{(*taken)->frame, (*taken)->time, (*taken)->clamped};
    return Result<std::optional<gateways::InboundFace>>(face);
  });
}

}  // namespace

// Only a mistake in the options themselves, or a lack of memory, throws here: both may end the program.
int main(int argc, char** argv) {  // NOLINT(bugprone-exception-escape)
  gateways::InboundOptions in;
  gateways::OutboundOptions out;
  in.program = out.program = "semblante-vmc";
  in.usual_port = out.usual_port = marionette_port;
  std::vector<std::string> blends = {"perfect-sync", "vrm0"};
  bool no_bones = false;

  CLI::App app{"Converts between the VMC protocol (OSC over UDP) and a stream of a Semblante server.", "semblante-vmc"};
  app.require_subcommand(1);
  auto* in_command = app.add_subcommand("in", "VMC -> stream: receives from a performer and publishes");
  gateways::add_inbound_options(*in_command, in);
  auto* out_command = app.add_subcommand("out", "stream -> VMC: follows a stream and sends to a marionette");
  out_command->add_option("--server", out.server.address, "http://HOST:PORT or https://HOST of the server")
      ->capture_default_str();
  semblante::client::declare_access_options(*out_command, out.server);
  out_command->add_option("--stream", out.stream, "id of the stream to follow")->required();
  out_command->add_option("--to", out.to, "HOST[:PORT] to send to; default port 39539")->capture_default_str();
  out_command->add_flag("--anywhere", out.anywhere, "allow another machine in --to");
  out_command
      ->add_option("--blends", blends, "blend values to send: perfect-sync (ARKit's names), vrm0, vrm1; repeatable")
      ->check(CLI::IsMember({"perfect-sync", "vrm0", "vrm1"}))
      ->delimiter(',')
      ->capture_default_str();
  out_command->add_flag("--no-bones", no_bones, "do not send the bones Neck, Head, LeftEye and RightEye");
  app.footer("Stops at SIGINT and SIGTERM, and then prints its counters.");
  CLI11_PARSE(app, argc, argv);

  const auto sends = [&blends](const char* set) {
    return std::find(blends.begin(), blends.end(), set) != blends.end();
  };
  out.sender = {sends("perfect-sync"), sends("vrm0"), sends("vrm1"), !no_bones};
  const Status done = in_command->parsed() ? receive(in) : gateways::run_outbound(out);
  if (!done) {
    std::cerr << "semblante-vmc: " << done.error().where << ": " << done.error().message << '\n';
    return 1;
  }
  return 0;
}
