#include "clients/native/tools/publish.h"

#include <algorithm>
#include <utility>

#include "clients/native/client/kernel_frame.h"
#include "clients/native/client/stream_refusal.h"
#include "protocol/cpp/quantizers.h"

namespace semblante::tools {
namespace {

using client::LiveStream;
using Clock = LiveStream::Clock;

Error lost(const LiveStream& stream) {
  return {ErrorCode::io, "stream",
          "no connection: " + (stream.loss() ? stream.loss()->message : "the server ended it")};
}

/// Reads what the server says until `until`, or until `done`; it sends only errors and the end.
template <class Done>
Status listen(LiveStream& stream, Clock::time_point until, Done done) {
  while (!done()) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(until - Clock::now());
    auto event = stream.next(std::max(left, std::chrono::milliseconds(0)));
    if (!event) return std::move(event).error();
    switch (event->type) {
      case SEMBLANTE_EVENT_NONE:
        return Unit{};
      case SEMBLANTE_EVENT_REFUSED:
        return Error{ErrorCode::invalid_argument, "stream" + event->error->where,
                     "error of the server: " + event->error->message};
      case SEMBLANTE_EVENT_FAULT:
        return std::move(*event->error);
      case SEMBLANTE_EVENT_END:
        return client::end_of_stream(event->code, "stream");
      default:
        if (stream.machine().state() == SEMBLANTE_STREAM_WAITING) return lost(stream);
    }
  }
  return Unit{};
}

Status listen(LiveStream& stream, Clock::time_point until) {
  return listen(stream, until, [] { return false; });
}

}  // namespace

Result<std::size_t> publish_frames(LiveStream& stream, std::span<const TimedFrame> frames,
                                   std::chrono::milliseconds patience) {
  if (auto fine = listen(stream, Clock::now() + patience, [&] { return stream.connected(); }); !fine) {
    return std::move(fine).error();
  }
  const Clock::time_point start = Clock::now();
  for (const TimedFrame& frame : frames) {
    if (auto fine = listen(stream, start + std::chrono::milliseconds(frame.time)); !fine) {
      return std::move(fine).error();
    }
    const semblante_timed_frame timed{0, client::to_kernel_frame(frame.state, standard_quantizers())};
    // 0 would mean the moment at which the server receives the frame.
    const double media_time = 1.0 + frame.time;
    if (stream.machine().publish({&timed, 1}, media_time, LiveStream::now()) != runtime::Stream::Published::sent) {
      return lost(stream);
    }
  }
  // Sends the last frame, and waits for a possible error about it.
  if (auto fine = listen(stream, Clock::now() + std::chrono::milliseconds(200)); !fine) {
    return std::move(fine).error();
  }
  return frames.size();
}

}  // namespace semblante::tools
