#include "clients/native/client/live_stream.h"

#include <algorithm>
#include <cmath>
#include <thread>
#include <utility>

#include "clients/native/client/carry.h"
#include "protocol/cpp/json_codec.h"

namespace semblante::client {
namespace {

using Clock = LiveStream::Clock;
using runtime::Event;

double to_ms(std::chrono::milliseconds time) { return static_cast<double>(time.count()); }

/// The earlier of a deadline and a time of the machine.
Clock::time_point earlier(Clock::time_point deadline, double wake_time) {
  const double left = wake_time - LiveStream::now();
  if (!(left < 1e9)) return deadline;
  return std::min(deadline, Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                               std::chrono::duration<double, std::milli>(std::max(left, 0.0))));
}

void append_json(const Message& message, const QuantizerSteps& steps, std::vector<std::uint8_t>& to) {
  const std::string text = encode_json(message, steps);
  to.insert(to.end(), text.begin(), text.end());
}

runtime::StreamOptions machine_options(const LiveStreamOptions& from) {
  runtime::StreamOptions options;
  options.role = from.role;
  options.take_over = from.take_over;
  options.resume = from.resume;
  options.retry_first = to_ms(from.first_pause);
  options.retry_longest = to_ms(from.longest_pause);
  options.silence_limit = to_ms(from.silence_limit);
  options.seed = from.seed;
  if (from.socket.json) options.encode = append_json;
  return options;
}

}  // namespace

LiveStream::LiveStream(ServerAddress server, std::string stream, LiveStreamOptions options)
    : server_(std::move(server)),
      stream_(std::move(stream)),
      options_(options.socket),
      machine_(machine_options(options)) {
  machine_.start(now());
}

double LiveStream::now() { return std::chrono::duration<double, std::milli>(Clock::now().time_since_epoch()).count(); }

void LiveStream::close() {
  machine_.stop();
  if (socket_) socket_->close();
  socket_.reset();
}

void LiveStream::lose(Error why) {
  loss_ = std::move(why);
  socket_.reset();
  machine_.closed(now());
}

Status LiveStream::connect() {
  ++connections_;
  auto socket = StreamSocket::open(server_, stream_, options_);
  if (!socket) {
    const ErrorCode code = socket.error().code;
    lose(std::move(socket).error());
    const bool is_final =
        code == ErrorCode::missing || code == ErrorCode::mismatch || code == ErrorCode::invalid_argument;
    return is_final ? Status(*loss_) : Unit{};
  }
  socket_.emplace(*std::move(socket));
  loss_.reset();
  machine_.opened(now());
  return Unit{};
}

Result<Event> LiveStream::obey() {
  machine_.tick(now());
  while (!machine_.events().empty()) {
    Event event = machine_.events().take();
    if (event.type == SEMBLANTE_EVENT_CLOSE) {
      socket_.reset();
    } else if (event.type == SEMBLANTE_EVENT_CONNECT) {
      if (auto connected = connect(); !connected) return std::move(connected).error();
    } else {
      return event;
    }
  }
  // If something cannot be sent, the next read reports the error.
  if (socket_) static_cast<void>(send_all(machine_, *socket_));
  return Event{};
}

void LiveStream::receive(Clock::time_point until) {
  const auto left = std::chrono::ceil<std::chrono::milliseconds>(until - Clock::now());
  auto bytes = socket_->read(std::max(left, std::chrono::milliseconds(0)));
  if (!bytes) return lose(std::move(bytes).error());
  if (!*bytes) return;
  const double received = now();
  const std::span<const std::uint8_t> data = **bytes;
  if (!options_.json) return machine_.receive(data, received);
  auto message = decode_json({reinterpret_cast<const char*>(data.data()), data.size()}, machine_.steps());
  if (message) return machine_.take(*message, received);
  // A message of a later version is skipped.
  if (message.error().code != ErrorCode::unsupported) machine_.fail(std::move(message).error(), received);
}

Result<Event> LiveStream::next(std::chrono::milliseconds timeout) {
  const auto deadline = Clock::now() + timeout;
  for (bool is_last = false;; is_last = Clock::now() >= deadline) {
    auto event = obey();
    if (!event || event->type != SEMBLANTE_EVENT_NONE || is_last) return event;
    const auto until = earlier(deadline, machine_.wake_time());
    if (socket_) {
      receive(until);
    } else {
      std::this_thread::sleep_until(until);
    }
  }
}

}  // namespace semblante::client
