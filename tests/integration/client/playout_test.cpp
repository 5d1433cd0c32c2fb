// A real server, a bad network, a client that plays. Only what holds on however busy a machine: how many milliseconds
// the picture is off is a matter of bench_clock, and of the simulated networks of tests/unit/client.

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <iostream>
#include <map>
#include <thread>

#include <gtest/gtest.h>

#include "clients/native/client/live_player.h"
#include "tests/integration/client/sample_server.h"
#include "tests/support/tcp_proxy.h"
#include "tests/support/true_clock.h"
#include "tests/support/wait.h"

namespace semblante::testing {
namespace {

using client::DisplayedFrame;
using client::LivePlayer;
using client::LiveStream;
using client::PlayedFrame;
using runtime::Playout;
using std::chrono::milliseconds;

/// Every frame of the demo, as a client gets it that nothing lies between. By sequence.
class Reference {
 public:
  explicit Reference(const client::Url& server) : stream_(server, "demo") {
    EXPECT_TRUE(eventually([&] { return pump() && !frames_.empty(); }, milliseconds(0)));
    thread_ = std::thread([this] {
      while (!stop_ || frames_.rbegin()->first < until_) {
        if (!pump()) return;
      }
    });
  }
  ~Reference() { frames_until(0); }
  Reference(const Reference&) = delete;
  Reference& operator=(const Reference&) = delete;

  /// Ends it once it has this frame.
  const std::map<std::uint64_t, PlayedFrame>& frames_until(std::uint64_t sequence) {
    until_ = sequence;
    stop_ = true;
    if (thread_.joinable()) thread_.join();
    return frames_;
  }

 private:
  bool pump() {
    const auto event = stream_.next(milliseconds(50));
    if (!event) return false;
    if (event->type != SEMBLANTE_EVENT_KEYFRAME && event->type != SEMBLANTE_EVENT_FRAMES) return true;
    std::uint64_t sequence = stream_.machine().newest().sequence;
    for (const semblante_timed_frame& each : stream_.machine().frames()) {
      frames_[sequence] = {sequence, each.time, each.frame};
      ++sequence;
    }
    return true;
  }

  LiveStream stream_;
  std::map<std::uint64_t, PlayedFrame> frames_;
  std::atomic<std::uint64_t> until_{0};
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

/// A display of some 60 Hz that checks what it is given. It knows no more of the moment at which a display frame was
/// made than that it lies between two readings of the clock, however far apart a busy machine puts them.
class Display {
 public:
  Display(LivePlayer& player, TrueClock clock) : player_(player), clock_(clock) {}

  /// False when the stream cannot be had.
  bool show_next() {
    if (!player_.receive(milliseconds(16))) return false;
    const auto snaps = player_.playout().stats().snaps;
    const double earliest = LiveStream::now();
    const auto shown = player_.show();
    const double latest = LiveStream::now();
    expect_true_clock(latest);
    if (shown) {
      expect_whole(*shown);
      if (last_) expect_onward(*shown, latest - last_earliest_, snaps);
      count_steady(*shown, earliest, latest);
      for (const PlayedFrame* each : {&shown->from, &shown->to}) frames[each->sequence] = *each;
      last_ = *shown;
    }
    last_earliest_ = earliest;
    return true;
  }
  /// Display frames in a row, up to the last one, that showed the stream's clock less the delay.
  [[nodiscard]] int steady() const { return steady_; }
  void count_anew() { steady_ = 0; }
  [[nodiscard]] const std::optional<DisplayedFrame>& last() const { return last_; }

  std::map<std::uint64_t, PlayedFrame> frames;  ///< all that were shown, by sequence

 private:
  /// The clock of the client is off by no more than it says.
  void expect_true_clock(double now) const {
    constexpr double drift = 3;  // ms that an estimated drift can come to from one ping to the next
    const auto& estimate = player_.playout().clock();
    if (const auto uncertainty = estimate.uncertainty()) {
      EXPECT_NEAR(*estimate.at(now), now + clock_.offset, *uncertainty + clock_.uncertainty + drift);
    }
  }
  /// Two neighbours of the stream, and a moment between them.
  void expect_whole(const DisplayedFrame& shown) const {
    EXPECT_LE(shown.from.sequence, shown.to.sequence);
    EXPECT_LE(shown.to.sequence, shown.from.sequence + 1) << "a frame of the stream was left out";
    EXPECT_GE(shown.t, 0.0F);
    EXPECT_LE(shown.t, 1.0F);
    EXPECT_LE(shown.media_time, player_.playout().newest());
    EXPECT_LE(shown.media_time, shown.to.media_time);
    if (shown.t > 0) {
      EXPECT_GE(shown.media_time, shown.from.media_time);
    }
  }
  /// Never back, and never faster than the playout may go, unless it jumps.
  void expect_onward(const DisplayedFrame& shown, double most_elapsed, std::uint64_t snaps) const {
    EXPECT_GE(shown.media_time, last_->media_time) << "back in time";
    EXPECT_GE(shown.from.sequence, last_->from.sequence);
    const bool jumped = player_.playout().stats().snaps > snaps || shown.media_time == player_.playout().newest();
    if (!jumped) {
      EXPECT_LE(shown.media_time - last_->media_time, (1 + Playout::max_speed_change) * most_elapsed + 0.01);
    }
  }
  void count_steady(const DisplayedFrame& shown, double earliest, double latest) {
    const double behind = clock_.offset - player_.playout().delay();
    const double off = std::max({0.0, earliest + behind - shown.media_time, shown.media_time - (latest + behind)});
    const double known = player_.playout().clock().uncertainty().value_or(1e9) + clock_.uncertainty;
    steady_ = known < 1e3 && off < 20 + known ? steady_ + 1 : 0;
  }

  LivePlayer& player_;
  TrueClock clock_;
  std::optional<DisplayedFrame> last_;
  double last_earliest_ = 0;
  int steady_ = 0;
};

TEST(Playout, RealServerBehindABadNetwork_ShowsTheStreamsClockLessItsDelay) {
  const SampleServer server;
  const client::Url url = *client::parse_url(server.url());
  const auto clock = measure_true_clock(url, "demo");
  ASSERT_TRUE(clock) << "the stream cannot be had";
  Reference reference(url);
  ProxyOptions network;
  network.target_port = static_cast<std::uint16_t>(std::stoi(url.port));
  network.delay = 30;
  network.jitter = 60;
  network.stalls = 0.01;
  network.seed = 7;
  TcpProxy proxy(network);
  LivePlayer player(client::Url{url.host, std::to_string(proxy.port()), ""}, "demo");
  Display display(player, *clock);

  // Two seconds of it without a fault. Late messages of the network or of the machine make the player wait, and its
  // delay longer, so that sooner or later it does not have to.
  constexpr int two_seconds = 120;
  const auto settles = [&] {
    display.count_anew();
    return eventually(
        [&] { return !display.show_next() || display.steady() >= two_seconds || ::testing::Test::HasFailure(); },
        milliseconds(0));
  };
  ASSERT_TRUE(settles()) << "it never shows the stream's clock less its delay; delay " << player.playout().delay();
  ASSERT_GE(display.steady(), two_seconds) << "the stream cannot be had";
  const auto before_the_cut = display.last()->to.sequence;
  const auto connections = player.stream().connections();
  proxy.cut();
  EXPECT_TRUE(eventually(
      [&] {
        return !display.show_next() || (player.stream().connections() > connections && player.stream().connected() &&
                                        display.last()->from.sequence > before_the_cut);
      },
      milliseconds(0)))
      << "it does not come back";
  EXPECT_TRUE(player.stream().header()->recovered) << "and has what was sent meanwhile";
  ASSERT_TRUE(settles()) << "nor does it again after the cut; delay " << player.playout().delay();
  ASSERT_GE(display.steady(), two_seconds);

  // What was shown is the stream: every frame of it, from the first that was shown to the last.
  const auto& frames = reference.frames_until(display.frames.rbegin()->first);
  for (const auto& [sequence, shown] : display.frames) {
    const auto same = frames.find(sequence);
    ASSERT_NE(same, frames.end()) << "frame " << sequence << " is not of the stream";
    EXPECT_EQ(same->second.media_time, shown.media_time) << sequence;
    EXPECT_EQ(std::memcmp(&same->second.frame, &shown.frame, sizeof shown.frame), 0) << "another face in " << sequence;
  }
  const auto stats = player.playout().stats();
  std::cout << display.frames.size() << " frames shown; delay " << stats.delay << " ms, starved " << stats.starved
            << ", jumped " << stats.snaps << ", clock within " << player.playout().clock().uncertainty().value_or(1e9)
            << " ms, the true one within " << clock->uncertainty << " ms\n";
}

}  // namespace
}  // namespace semblante::testing
