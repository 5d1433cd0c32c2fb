#include "tests/unit/runtime/playout_simulation.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <random>

namespace semblante::testing {
namespace {

constexpr double display_interval = 1000.0 / 60;
constexpr double client_origin = 7'000'000;
constexpr double stream_origin = 50'000;

class Simulation {
 public:
  Simulation(const NetworkModel& network, const SimulationOptions& options)
      : network_(network), options_(options), random_(options.seed), playout_({options.delay, false}) {}

  SimulationResult run() {
    const double end = options_.minutes * 60'000;
    connect();
    at(1, [this] { send_batch(); });
    at(3, [this] { display(); });
    if (network_.loss_every > 0) {
      at(uniform(0.5, 1.5) * network_.loss_every * 1000, [this] { lose(); });
    }
    while (!events_.empty() && events_.begin()->first < end) {
      const auto event = events_.extract(events_.begin());
      now_ = event.key();
      event.mapped()();
    }
    std::sort(result_.skew.begin(), result_.skew.end());
    const auto frames = static_cast<double>(result_.skew.size());
    result_.held_share = static_cast<double>(held_) / frames;
    result_.mean_delay = delays_ / frames;
    result_.snaps = playout_.stats().snaps;
    result_.starved = playout_.stats().starved;
    return result_;
  }

 private:
  [[nodiscard]] double stream_clock() const { return stream_origin + now_ * (1 + network_.drift); }
  [[nodiscard]] double client_clock() const { return client_origin + now_; }
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  void at(double when, std::function<void()> what) { events_.emplace(when, std::move(what)); }

  /// When a message sent now is there, after all those before it.
  double arrival(double& last) {
    const bool burst = network_.burst_every > 0 && std::fmod(now_ / 1000, network_.burst_every) < 2;
    double delay = network_.base + uniform(0, network_.jitter) * (burst ? 4 : 1);
    if (uniform(0, 1) < network_.stalls) {
      delay += network_.stall;
    }
    last = std::max(last, now_ + delay);
    return last;
  }
  /// Runs `what` at the client when it is there, unless the connection is lost before.
  void deliver_down(std::function<void()> what) {
    at(arrival(last_down_), [this, connection = connection_, what = std::move(what)] {
      if (connection == connection_) what();
    });
  }

  void connect() {
    const double sent = client_clock();
    last_up_ = last_down_ = now_;
    ++connection_;
    at(arrival(last_up_), [this, sent, connection = connection_] {
      if (connection != connection_) return;
      Header header;
      header.epoch = 1;
      header.media_time = whole_clock();
      header.batch_interval = static_cast<std::uint32_t>(options_.batch_interval);
      header.fps_hint = 1000 / options_.frame_interval;
      subscribed_ = true;
      const double from = has_until_;
      const double until = sent_until_;
      deliver_down([this, header, sent, from, until] {
        pings_ = 0;
        playout_.clock().answered(sent, client_clock(), static_cast<double>(header.media_time));
        playout_.begin(header);
        online_ = true;
        ping();
        receive(from, until);
      });
    });
  }

  std::uint64_t whole_clock() const { return static_cast<std::uint64_t>(stream_clock()); }

  void ping() {
    if (!online_) return;
    const double sent = client_clock();
    at(arrival(last_up_), [this, sent, connection = connection_] {
      if (connection != connection_) return;
      deliver_down([this, sent, media_time = static_cast<double>(whole_clock())] {
        playout_.clock().answered(sent, client_clock(), media_time);
      });
    });
    at(now_ + runtime::ping_pause(++pings_, playout_.clock().uncertainty().value_or(0)),
       [this, connection = connection_] {
         if (connection == connection_) ping();
       });
  }

  /// The frames since the last batch, each at a multiple of the frame interval of the stream's clock.
  void send_batch() {
    const double until = std::floor(stream_clock() / options_.frame_interval) * options_.frame_interval;
    if (until > sent_until_) {
      if (subscribed_) {
        deliver_down([this, from = sent_until_, until] { receive(from, until); });
      }
      sent_until_ = until;
    }
    at(now_ + options_.batch_interval, [this] { send_batch(); });
  }

  void receive(double from, double until) {
    from = std::max(from, has_until_);
    if (until <= from) return;
    const double first = from > 0 ? from + options_.frame_interval : until;
    playout_.arrived(first, std::max(first, until - options_.frame_interval), until, client_clock());
    has_until_ = until;
  }

  void lose() {
    ++result_.losses;
    ++connection_;
    online_ = subscribed_ = false;
    lost_ = true;
    at(now_ + uniform(1000, 5000), [this] {
      connect();
      at(now_ + 2000, [this] { lost_ = false; });
    });
    at(now_ + uniform(0.5, 1.5) * network_.loss_every * 1000 + 8000, [this] { lose(); });
  }

  void display() {
    const double elapsed = now_ - displayed_at_;
    displayed_at_ = now_;
    const double before = playout_.playhead();
    const std::uint64_t snaps = playout_.stats().snaps;
    playout_.advance(client_clock(), elapsed);
    const double shown = playout_.playhead();
    if (shown < before) ++result_.backwards;
    if (now_ > options_.settled) {
      const double ideal = stream_clock() - playout_.delay();
      const bool held = shown >= playout_.newest();
      if (!lost_) {
        result_.skew.push_back(std::abs(shown - ideal));
        delays_ += playout_.delay();
        held_ += held ? 1 : 0;
        result_.worst_clock_error =
            std::max(result_.worst_clock_error, std::abs(*playout_.clock().at(client_clock()) - stream_clock()));
      }
      if (!held && playout_.stats().snaps == snaps && !lost_) {
        result_.slowest = std::min(result_.slowest, (shown - before) / elapsed);
        result_.fastest = std::max(result_.fastest, (shown - before) / elapsed);
      }
      result_.shown.push_back(lost_ ? std::nan("") : shown - stream_clock());
    }
    // Displays are even, but the program that feeds them is not quite.
    at(++frames_ * display_interval + uniform(0, 4), [this] { display(); });
  }

  const NetworkModel network_;
  const SimulationOptions options_;
  std::mt19937_64 random_;
  runtime::Playout playout_;
  std::multimap<double, std::function<void()>> events_;
  double now_ = 0, last_up_ = 0, last_down_ = 0, displayed_at_ = 0;
  double sent_until_ = 0, has_until_ = 0;
  double delays_ = 0;
  std::uint64_t connection_ = 0, frames_ = 0, held_ = 0;
  std::size_t pings_ = 0;
  bool online_ = false, subscribed_ = false, lost_ = false;
  SimulationResult result_;
};

}  // namespace

SimulationResult simulate(const NetworkModel& network, const SimulationOptions& options) {
  return Simulation(network, options).run();
}

}  // namespace semblante::testing
