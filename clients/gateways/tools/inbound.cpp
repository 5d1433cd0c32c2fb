#include "clients/gateways/tools/inbound.h"

#include <chrono>
#include <exception>
#include <iostream>
#include <utility>

#include <CLI/CLI.hpp>

#include "clients/gateways/net/media_timeline.h"
#include "clients/gateways/net/rate_limit.h"
#include "clients/gateways/net/udp_socket.h"
#include "clients/gateways/tools/stop_signal.h"

namespace semblante::gateways {
namespace {

using Clock = std::chrono::steady_clock;

/// Packets read in sequence before the connection is served.
constexpr int packets_at_once = 256;

struct Counts {
  std::uint64_t packets = 0;    ///< received
  std::uint64_t refused = 0;    ///< invalid packets
  std::uint64_t throttled = 0;  ///< packets over the limit
  std::uint64_t frames = 0;     ///< published
  std::uint64_t dropped = 0;    ///< faces over the rate limit, or without a connection
  std::uint64_t clamped = 0;    ///< values outside 0..1
};

class Inbound {
 public:
  Inbound(const InboundOptions& options, client::ServerAddress server, const Decode& decode)
      : options_(options),
        decode_(decode),
        publisher_(std::move(server), options.stream, options.publisher),
        packets_(options.max_packets),
        faces_(options.max_fps) {}

  Status run(UdpSocket& socket) {
    while (!stop_requested()) {
      if (auto fine = publisher_.look_after(); !fine) return fine;
      if (const auto news = publisher_.take_news()) std::cerr << options_.program << ": " << *news << '\n';
      if (!socket.wait(std::chrono::milliseconds(waiting_ ? 2 : 20))) {
        publish_waiting();
        continue;
      }
      for (int i = 0; i < packets_at_once; ++i) {
        const auto packet = socket.receive();
        if (!packet) break;
        try {
          take(*packet);
        } catch (const std::exception& fault) {
          refused("", fault.what());
        }
      }
      publish_waiting();
    }
    publisher_.close();
    return Unit{};
  }

  void print_counts() const {
    std::cout << "packets " << counts_.packets << ", refused " << counts_.refused << ", throttled " << counts_.throttled
              << ", frames " << counts_.frames << ", dropped " << counts_.dropped << ", clamped " << counts_.clamped
              << std::endl;
  }

 private:
  [[nodiscard]] double now() const { return std::chrono::duration<double>(Clock::now() - begin_).count(); }

  void take(std::span<const std::uint8_t> packet) {
    ++counts_.packets;
    const double arrival = now();
    if (!packets_.admits(arrival)) {
      ++counts_.throttled;
      return;
    }
    auto face = decode_(packet, arrival);
    if (!face) {
      return refused(face.error().where, face.error().message);
    }
    if (!*face) return;
    counts_.clamped += (*face)->clamped;
    // A waiting face is replaced by a newer one: only the newest state matters.
    counts_.dropped += waiting_ ? 1 : 0;
    waiting_ = {**face, timeline_.place((*face)->seconds, arrival)};
    publish_waiting();
  }

  void refused(std::string_view where, std::string_view why) {
    // Logged once: packets of a stranger must not fill the log.
    if (counts_.refused++ > 0) return;
    std::cerr << options_.program << ": invalid packet: " << where << ": " << why << '\n';
  }

  void publish_waiting() {
    if (!waiting_ || !faces_.admits(now())) return;
    const bool sent = publisher_.publish(waiting_->first.frame, waiting_->second);
    ++(sent ? counts_.frames : counts_.dropped);
    waiting_.reset();
  }

  const InboundOptions& options_;
  const Decode& decode_;
  client::StreamPublisher publisher_;
  RateLimit packets_, faces_;
  MediaTimeline timeline_;
  std::optional<std::pair<InboundFace, std::uint64_t>> waiting_;  ///< and its media time
  Counts counts_;
  Clock::time_point begin_ = Clock::now();
};

}  // namespace

void add_inbound_options(CLI::App& app, InboundOptions& options) {
  app.add_option("--server", options.server.address, "http://HOST:PORT or https://HOST of the server")
      ->capture_default_str();
  client::declare_access_options(app, options.server);
  app.add_option("--stream", options.stream, "id of the stream to publish to")->required();
  app.add_flag("--create", options.publisher.create, "create the stream if it does not exist");
  app.add_option("--model", options.publisher.model, "with --create: the model that the stream suggests");
  app.add_flag("--take-over", options.publisher.take_over, "publish even if another client publishes");
  app.add_option("--listen", options.listen,
                 "HOST[:PORT] of this machine to receive at; 0.0.0.0 for packets of other machines; default port " +
                     options.usual_port)
      ->capture_default_str();
  app.add_option("--max-packets", options.max_packets,
                 "maximum number of packets per second; further packets are not read")
      ->check(CLI::Range(1.0, 1e6))
      ->capture_default_str();
  app.add_option("--max-fps", options.max_fps,
                 "maximum number of frames per second; only the newest of more are published")
      ->check(CLI::Range(1.0, 400.0))
      ->capture_default_str();
}

Status run_inbound(const InboundOptions& options, const Decode& decode) {
  auto server = options.server.parse();
  if (!server) return std::move(server).error();
  const auto at = parse_endpoint(options.listen, options.usual_port);
  if (!at) return at.error();
  auto socket = UdpSocket::listen(*at);
  if (!socket) return std::move(socket).error();
  catch_stop_signals();
  std::cout << "listening at " << at->host << " port " << socket->port() << " for stream " << options.stream
            << std::endl;
  Inbound inbound(options, *std::move(server), decode);
  auto ran = inbound.run(*socket);
  inbound.print_counts();
  return ran;
}

}  // namespace semblante::gateways
