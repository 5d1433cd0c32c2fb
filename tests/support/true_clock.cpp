#include "tests/support/true_clock.h"

#include <chrono>

#include "clients/native/client/live_stream.h"
#include "tests/support/stream_speaker.h"
#include "tests/support/wait.h"

namespace semblante::testing {
namespace {

struct RoundTrip {
  double sent = 0, received = 0;
  std::uint64_t media_time = 0;
};

std::optional<RoundTrip> ping(StreamSpeaker& stream, std::uint32_t id) {
  Ping ping;
  ping.id = id;
  ping.client_time = client::LiveStream::now();
  if (!stream.send(ping)) return std::nullopt;
  while (true) {
    const auto message = stream.next(patience);
    if (!message || !*message) return std::nullopt;
    if (const auto* pong = std::get_if<Pong>(&**message); pong != nullptr && pong->id == id) {
      return RoundTrip{ping.client_time, client::LiveStream::now(), pong->media_time};
    }
  }
}

}  // namespace

std::optional<TrueClock> measure_true_clock(const client::Url& server, const std::string& stream) {
  auto direct = StreamSpeaker::connect(server, stream, Hello(), patience);
  if (!direct) return std::nullopt;
  // The shortest of some round trips says most. A busy machine answers late: then more of them are waited for.
  constexpr std::uint32_t least = 20;
  constexpr std::uint32_t most = 500;
  constexpr double short_enough = 2;  // ms
  std::optional<RoundTrip> best;
  const auto length = [](const RoundTrip& trip) { return trip.received - trip.sent; };
  for (std::uint32_t id = 1; id <= least || (id <= most && length(*best) > short_enough); ++id) {
    const auto trip = ping(*direct, id);
    if (!trip) return std::nullopt;
    if (!best || length(*trip) < length(*best)) best = trip;
  }
  // Whole ms, cut off, at a moment between the two.
  return TrueClock{static_cast<double>(best->media_time) + 0.5 - (best->sent + best->received) / 2,
                   length(*best) / 2 + 0.5};
}

}  // namespace semblante::testing
