#include "tests/bench/fanout/publisher.h"

#include <algorithm>
#include <span>

#include "protocol/cpp/frame_codec.h"
#include "tests/bench/fanout/trace.h"
#include "tests/bench/fanout/websocket_wire.h"
#include "tests/support/frame_encoder.h"

namespace semblante::bench {
namespace {

using Clock = std::chrono::steady_clock;

std::string frame_of(FrameEncoder& encoder, const Message& message) {
  const auto bytes = encoder.encode(message);
  return client_frame(Opcode::binary, std::string(bytes.begin(), bytes.end()));
}

}  // namespace

Socket open_websocket(const Endpoint& endpoint, const std::string& path, std::string_view subprotocol,
                      int receive_buffer) {
  Socket socket = connect_to(endpoint, receive_buffer);
  send_all(socket, upgrade_request(endpoint.authority(), path, subprotocol));
  // A byte at a time, so that nothing after the head is taken with it.
  std::string head;
  for (char c = 0; !head.ends_with("\r\n\r\n"); head.push_back(c))
    if (socket.receive_in_time(&c, 1) != 1) give_up("the handshake for " + path + " was cut off");
  if (!head.starts_with("HTTP/1.1 101"))
    give_up("the handshake for " + path + " was answered " + head.substr(0, head.find("\r\n")));
  return socket;
}

Publisher::Publisher(const Endpoint& endpoint, const std::string& path, const Feed& feed, SendTimes& sent)
    : socket_(open_websocket(endpoint, path, binary_subprotocol)), feed_(feed), sent_(sent) {
  Hello hello;
  hello.role = StreamRole::publish;
  FrameEncoder encoder;
  send_all(socket_, frame_of(encoder, hello));
  char first = 0;  // the header says that it may publish
  if (socket_.receive_in_time(&first, 1) != 1) give_up("the server does not let the bench publish to " + path);
  received_.push_back(first);
  thread_ = std::thread([this] { run(); });
}

Publisher::~Publisher() {
  stop_ = true;
  thread_.join();
}

void Publisher::run() {
  FrameEncoder encoder;
  const auto begin = Clock::now();
  const auto media_time = [&] {
    return 1 + static_cast<std::uint64_t>(
                   std::chrono::duration_cast<std::chrono::milliseconds>(Clock::now() - begin).count());
  };
  std::uint64_t number = 1;
  const auto publish = [&](const Message& message, std::uint64_t frames) {
    const auto bytes = frame_of(encoder, message);
    const auto now = now_ns();
    for (std::uint64_t i = 0; i < frames; ++i) sent_.set(number + i, now);
    if (!socket_.send_all_in_time(bytes)) lost_ = true;
    number += frames;
    frames_sent_ = number - 1;
  };
  publish(Keyframe{1, media_time(), trace_frame(1, feed_.heavy)}, 1);

  const std::chrono::duration<double> interval(1.0 / feed_.messages_per_second);
  const double frame_ms = interval.count() * 1000.0 / static_cast<double>(feed_.frames_per_message);
  for (std::uint64_t round = 1; !lost_; ++round) {
    const auto due = begin + std::chrono::duration_cast<Clock::duration>(interval * static_cast<double>(round));
    while (!stop_ && Clock::now() < due)
      std::this_thread::sleep_until(std::min(due, Clock::now() + std::chrono::milliseconds(100)));
    if (stop_ || number + feed_.frames_per_message > sent_.room()) return;
    Frames batch;
    batch.sequence = number;
    batch.media_time = media_time();
    for (std::size_t i = 0; i < feed_.frames_per_message; ++i)
      batch.frames.push_back(
          {static_cast<std::uint32_t>(frame_ms * static_cast<double>(i)), trace_frame(number + i, feed_.heavy)});
    publish(batch, feed_.frames_per_message);
    listen();
  }
}

void Publisher::listen() {
  char buffer[16 * 1024];
  for (ssize_t size = 0; (size = socket_.receive(buffer, sizeof buffer)) >= 0;) {
    if (size == 0) {
      lost_ = true;
      return;
    }
    received_.append(buffer, static_cast<std::size_t>(size));
  }
  FrameHead head;
  while (read_head(received_, head) == HeadState::complete &&
         received_.size() >= head.head_bytes + head.payload_bytes) {
    const auto payload = received_.substr(head.head_bytes, head.payload_bytes);
    received_.erase(0, head.head_bytes + head.payload_bytes);
    if (head.opcode == Opcode::ping && !socket_.send_all_in_time(client_frame(Opcode::pong, payload))) lost_ = true;
    if (head.opcode == Opcode::close) lost_ = true;
    if (head.opcode != Opcode::binary) continue;
    const auto message =
        FrameDecoder().decode(std::span(reinterpret_cast<const std::uint8_t*>(payload.data()), payload.size()));
    if (!message) continue;
    if (const auto* error = std::get_if<StreamError>(&*message)) {
      ++errors_;
      if (error->code == StreamErrorCode::throttled) ++throttled_;
    }
  }
}

}  // namespace semblante::bench
