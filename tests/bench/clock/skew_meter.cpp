#include "tests/bench/clock/skew_meter.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <thread>

#include "clients/native/client/live_player.h"
#include "tests/support/true_clock.h"

namespace semblante::testing {
namespace {

using client::LivePlayer;
using client::LiveStream;
using std::chrono::milliseconds;
using Clock = std::chrono::steady_clock;

/// A display frame that comes later than this after its time (ms), or a proxy that is, tells of the machine, not of us.
constexpr double disturbance = 8;

}  // namespace

bool Skew::calm() const { return disturbed * 50 < sorted.size() && worst_proxy < disturbance && truth < 3; }

std::optional<Skew> measure_skew(const SkewOptions& options) {
  Skew skew;
  const auto clock = measure_true_clock(options.server, options.stream);
  if (!clock) return std::nullopt;
  skew.truth = clock->uncertainty;
  ProxyOptions network = options.network;
  network.target_port = static_cast<std::uint16_t>(std::stoi(options.server.port));
  TcpProxy proxy(network);
  LivePlayer player(client::Url{options.server.host, std::to_string(proxy.port()), options.server.path}, options.stream,
                    {}, {options.delay, false});
  double before = -std::numeric_limits<double>::infinity();
  double newest = before, plain_offset = 0, interval = 0;
  bool cut = !options.cut_half_way;
  const auto begin = Clock::now();
  auto next = begin;
  auto counts_from = begin + options.settled_after;
  while (Clock::now() < begin + options.shown_for) {
    next += std::chrono::microseconds(16'667);
    while (Clock::now() < next) {
      const auto wait = std::chrono::ceil<milliseconds>(next - Clock::now());
      if (!player.receive(std::min(wait, milliseconds(2)))) return std::nullopt;
      if (player.playout().newest() > newest) {
        interval = std::isfinite(newest) ? player.playout().newest() - newest : 0;
        newest = player.playout().newest();
        plain_offset = newest - LiveStream::now();
      }
    }
    const double late = std::chrono::duration<double, std::milli>(Clock::now() - next).count();
    next = std::max(next, Clock::now() - milliseconds(50));
    const auto shown = player.show();
    const double now = LiveStream::now();
    ++skew.frames;
    if (!cut && Clock::now() > begin + options.shown_for / 2) {
      proxy.cut();
      cut = true;
      counts_from = Clock::now() + std::chrono::seconds(2);
    }
    if (!shown) continue;
    skew.backwards += shown->media_time < before ? 1 : 0;
    before = shown->media_time;
    if (Clock::now() < counts_from) continue;
    skew.worst_late = std::max(skew.worst_late, late);
    if (late > disturbance) {
      ++skew.disturbed;
      continue;
    }
    skew.sorted.push_back(std::abs(shown->media_time - (now + clock->offset - player.playout().delay())));
    // Its delay is what it has on average: only how uneven it is counts.
    skew.plain_sorted.push_back(std::min(plain_offset + now, newest + 2 * interval) - (now + clock->offset));
  }
  std::sort(skew.sorted.begin(), skew.sorted.end());
  std::sort(skew.plain_sorted.begin(), skew.plain_sorted.end());
  const double middle = skew.plain_at(0.5);
  for (double& each : skew.plain_sorted) each = std::abs(each - middle);
  std::sort(skew.plain_sorted.begin(), skew.plain_sorted.end());
  skew.worst_proxy = proxy.counts().worst_lateness;
  skew.connections = player.stream().connections();
  skew.stats = player.playout().stats();
  skew.uncertainty = player.playout().clock().uncertainty().value_or(1e9);
  return skew;
}

}  // namespace semblante::testing
