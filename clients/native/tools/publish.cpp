#include "clients/native/tools/publish.h"

#include <thread>
#include <utility>

#include "protocol/cpp/json_codec.h"

namespace semblante::tools {
namespace {

using Clock = std::chrono::steady_clock;

/// Reads messages of the server until `until`; it sends only errors and the end.
Status listen(client::StreamClient& stream, Clock::time_point until) {
  while (true) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(until - Clock::now());
    auto message = stream.next(std::max(left, std::chrono::milliseconds(0)));
    if (!message) {
      return std::move(message).error();
    }
    if (!*message) {
      return Unit{};
    }
    if (const auto* error = std::get_if<StreamError>(&**message)) {
      return Error{ErrorCode::invalid_argument, "stream" + error->where, "error of the server: " + error->message};
    }
    if (std::holds_alternative<End>(**message)) {
      return Error{ErrorCode::io, "stream", "the server ended the stream"};
    }
  }
}

}  // namespace

Result<std::size_t> publish_frames(client::StreamClient& stream, std::string_view json) {
  const auto frames = decode_json_frames(json);
  if (!frames) {
    return frames.error();
  }
  const Clock::time_point start = Clock::now();
  std::uint64_t sequence = 0;
  for (const TimedFrame& frame : *frames) {
    if (auto fine = listen(stream, start + std::chrono::milliseconds(frame.time)); !fine) {
      return std::move(fine).error();
    }
    ++sequence;
    // The first frame is complete; each later one is a difference to the one before it.
    const Message message = sequence == 1 ? Message(Keyframe{sequence, frame.time, frame.state})
                                          : Message(Frames{sequence, frame.time, {TimedFrame{0, frame.state}}});
    if (auto sent = stream.send(message); !sent) {
      return std::move(sent).error();
    }
  }
  // Waits for a possible error about the last frame.
  if (auto fine = listen(stream, Clock::now() + std::chrono::milliseconds(200)); !fine) {
    return std::move(fine).error();
  }
  return frames->size();
}

}  // namespace semblante::tools
