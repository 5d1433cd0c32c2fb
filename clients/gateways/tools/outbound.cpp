#include "clients/gateways/tools/outbound.h"

#include <algorithm>
#include <chrono>
#include <deque>
#include <iostream>
#include <optional>
#include <utility>
#include <variant>

#include "clients/gateways/net/pacer.h"
#include "clients/gateways/net/udp_socket.h"
#include "clients/gateways/tools/stop_signal.h"
#include "clients/native/client/live_stream.h"
#include "protocol/cpp/kernel_values.h"

namespace semblante::gateways {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr std::size_t most_waiting = 1024;  ///< frames that are not due yet
constexpr double repeat_ms = 250.0;
constexpr milliseconds longest_wait{20};  ///< between checks for a signal
constexpr milliseconds connect_time{3000};
constexpr milliseconds first_retry{250};
constexpr milliseconds last_retry{5000};

class Outbound {
 public:
  Outbound(const OutboundOptions& options, client::ServerAddress server, UdpSocket& socket)
      : options_(options), server_(std::move(server)), socket_(socket) {}

  Status run() {
    while (!stop_requested()) {
      auto ended = follow();
      if (!ended) return ended;
      for (const auto until = Clock::now() + first_retry; Clock::now() < until && !stop_requested();) {
        send_due();
        static_cast<void>(socket_.wait(longest_wait));
      }
    }
    return Unit{};
  }

  void print_counts() const {
    std::cout << "packets " << packets_ << ", refused " << refused_ << ", frames " << frames_ << ", repeated "
              << repeated_ << std::endl;
  }

 private:
  [[nodiscard]] double now() const { return std::chrono::duration<double, std::milli>(Clock::now() - begin_).count(); }

  [[nodiscard]] client::LiveStreamOptions wanted() const {
    client::LiveStreamOptions options;
    options.socket.timeout = connect_time;
    options.resume = resume_;
    options.first_pause = first_retry;
    options.longest_pause = last_retry;
    return options;
  }

  /// Until the stream ends for good, which may be there again later. Errors: there is no such stream.
  Status follow() {
    client::LiveStream stream(server_, options_.stream, wanted());
    bool was_waiting = false;
    while (!stop_requested()) {
      const double left = waiting_.empty() ? static_cast<double>(longest_wait.count()) : waiting_.front().first - now();
      const milliseconds patience(
          std::clamp<long long>(static_cast<long long>(left), 1, static_cast<long long>(longest_wait.count())));
      auto event = stream.next(patience);
      if (!event) return std::move(event).error();
      const bool is_waiting = stream.machine().state() == SEMBLANTE_STREAM_WAITING;
      if (is_waiting && !was_waiting) {
        std::cerr << options_.program << ": no connection to " << options_.stream << '\n';
      }
      was_waiting = is_waiting;
      take(*event, stream.machine());
      if (event->type == SEMBLANTE_EVENT_END && event->is_final) {
        resume_ = stream.resume();
        break;
      }
      send_due();
    }
    stream.close();
    return Unit{};
  }

  void take(const runtime::Event& event, const runtime::Stream& machine) {
    const Frames& newest = machine.newest();
    if (event.type == SEMBLANTE_EVENT_KEYFRAME) {
      // The current state, however old, replaces all waiting frames.
      steps_ = machine.steps();
      waiting_.clear();
      waiting_.emplace_back(now(), newest.frames.front().state);
    } else if (event.type == SEMBLANTE_EVENT_FRAMES) {
      const auto base = static_cast<double>(newest.media_time);
      pacer_.arrived(base + newest.frames.front().time, now());
      for (const TimedFrame& frame : newest.frames) waiting_.emplace_back(pacer_.due(base + frame.time), frame.state);
      while (waiting_.size() > most_waiting) waiting_.pop_front();
    } else if (event.type == SEMBLANTE_EVENT_REFUSED) {
      std::cerr << options_.program << ": error of the server: " << event.error->message << '\n';
    }
  }

  void send_due() {
    const double moment = now();
    while (!waiting_.empty() && waiting_.front().first <= moment) {
      newest_ = to_kernel_frame(to_values(waiting_.front().second, steps_));
      waiting_.pop_front();
      say(moment);
      ++frames_;
    }
    if (newest_ && moment - said_ > repeat_ms) {
      say(moment);
      ++repeated_;
    }
  }

  void say(double moment) {
    for (const auto& packet : vmc::packets_of(*newest_, moment / 1000.0, options_.sender)) {
      ++(socket_.send(packet) ? packets_ : refused_);
    }
    said_ = moment;
  }

  const OutboundOptions& options_;
  client::ServerAddress server_;
  UdpSocket& socket_;
  QuantizerSteps steps_ = standard_quantizers();
  std::optional<ResumePoint> resume_;
  Pacer pacer_;
  std::deque<std::pair<double, FaceFrame>> waiting_;  ///< with their due times
  std::optional<semblante_frame> newest_;
  double said_ = 0.0;
  std::uint64_t packets_ = 0, refused_ = 0, frames_ = 0, repeated_ = 0;
  Clock::time_point begin_ = Clock::now();
};

}  // namespace

Status run_outbound(const OutboundOptions& options) {
  auto server = options.server.parse();
  if (!server) return std::move(server).error();
  const auto to = parse_endpoint(options.to, options.usual_port);
  if (!to) return to.error();
  auto socket = UdpSocket::send_to(*to, options.anywhere);
  if (!socket) return std::move(socket).error();
  catch_stop_signals();
  std::cout << "sending stream " << options.stream << " to " << to->host << " port " << to->port << std::endl;
  Outbound outbound(options, *std::move(server), *socket);
  auto ran = outbound.run();
  outbound.print_counts();
  return ran;
}

}  // namespace semblante::gateways
