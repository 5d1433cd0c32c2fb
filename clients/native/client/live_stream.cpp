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
  options.role = from.stream.role;
  options.take_over = from.stream.take_over;
  options.resume = from.stream.resume;
  options.coding = from.stream.json ? StreamCoding::plain : from.stream.coding;
  options.retry_first = to_ms(from.first_pause);
  options.retry_longest = to_ms(from.longest_pause);
  options.seed = from.seed;
  if (from.stream.json) options.encode = append_json;
  return options;
}

}  // namespace

LiveStream::LiveStream(ServerAddress server, std::string stream, LiveStreamOptions options)
    : server_(std::move(server)),
      stream_(std::move(stream)),
      options_(options.stream),
      machine_(machine_options(options)) {
  machine_.start(now());
}

double LiveStream::now() { return std::chrono::duration<double, std::milli>(Clock::now().time_since_epoch()).count(); }

void LiveStream::close() {
  machine_.stop();
  if (client_) client_->close();
  client_.reset();
}

Status LiveStream::connect() {
  ++connections_;
  decoder_.reset();
  auto client = StreamClient::open(server_, stream_, options_);
  if (!client) {
    machine_.closed(now());
    const ErrorCode code = client.error().code;
    const bool is_final =
        code == ErrorCode::missing || code == ErrorCode::mismatch || code == ErrorCode::invalid_argument;
    return is_final ? Status(std::move(client).error()) : Unit{};
  }
  client_.emplace(*std::move(client));
  machine_.opened(now());
  return Unit{};
}

Status LiveStream::obey() {
  machine_.tick(now());
  while (!machine_.events().empty()) {
    const runtime::Event event = machine_.events().take();
    if (event.type == SEMBLANTE_EVENT_CLOSE) client_.reset();
    if (event.type != SEMBLANTE_EVENT_CONNECT) continue;
    if (auto connected = connect(); !connected) return connected;
  }
  // If something cannot be sent, the next read reports the error.
  if (client_) static_cast<void>(send_all(machine_, *client_, options_.json));
  return Unit{};
}

std::optional<Message> LiveStream::receive(Clock::time_point until) {
  const auto left = std::chrono::ceil<std::chrono::milliseconds>(until - Clock::now());
  auto bytes = client_->read(std::max(left, std::chrono::milliseconds(0)));
  if (!bytes) {
    client_.reset();
    machine_.closed(now());
    return std::nullopt;
  }
  if (!*bytes) return std::nullopt;
  const double received = now();
  const std::span<const std::uint8_t> data = **bytes;
  auto message = options_.json
                     ? decode_json({reinterpret_cast<const char*>(data.data()), data.size()}, machine_.steps())
                     : decoder_.decode(data);
  if (message) {
    machine_.take(*message, received);
    return *std::move(message);
  }
  if (message.error().code != ErrorCode::unsupported) machine_.fail(std::move(message).error(), received);
  return std::nullopt;
}

Result<std::optional<Message>> LiveStream::next(std::chrono::milliseconds timeout) {
  const auto deadline = Clock::now() + timeout;
  while (true) {
    if (auto done = obey(); !done) return std::move(done).error();
    const auto until = earlier(deadline, machine_.wake_time());
    std::optional<Message> message;
    if (client_) {
      message = receive(until);
    } else {
      std::this_thread::sleep_until(until);
    }
    if (message) {
      if (auto done = obey(); !done) return std::move(done).error();
      return message;
    }
    if (Clock::now() >= deadline) return std::optional<Message>();
  }
}

}  // namespace semblante::client
