#pragma once

#include <cstddef>
#include <deque>
#include <optional>

namespace semblante::client {

/// The stream's clock as a client knows it: its distance from the client's own clock, from the round trips of hello and
/// header and of ping and pong. Times in ms; the client's clock may have any origin but must not be set by hand.
/// protocol/SPEC.md, 7.1; clients/js/clock_estimate.ts is the same, and protocol/vectors/clock holds the two together.
class ClockEstimate {
 public:
  /// Round trips older than this no longer count.
  static constexpr double window = 60'000;
  /// How fast two clocks part at most beyond what is known of them, ms per ms.
  static constexpr double drift_slack = 300e-6;
  static constexpr double greatest_drift = 500e-6;
  /// Clocks are compared over this time at least before their drift is told, and this at most.
  static constexpr double drift_least_span = 120'000;
  static constexpr double drift_span = 600'000;
  static constexpr double drift_step = 30'000;
  /// Frames come at most so far ahead of the stream's clock: the server takes none that are farther.
  static constexpr double farthest_ahead = 10'000;
  /// Without any round trip the earliest arrival within this time counts.
  static constexpr double heard_window = 10'000;

  /// A message sent at `sent` was answered by one that came at `received` and says that the stream's clock was at
  /// `media_time`, whole ms, in between.
  void answered(double sent, double received, double media_time);
  /// The newest frame of a message that came at `received` is of `media_time`. All there is until the first answer.
  void heard(double received, double media_time);
  /// Forgets everything: another stream or epoch.
  void clear();

  /// The stream's clock when ours is at `local`; nullopt before anything came.
  [[nodiscard]] std::optional<double> at(double local) const;
  /// The estimate is off by at most this, ms; nullopt before the first answer.
  [[nodiscard]] std::optional<double> uncertainty() const;
  /// How much faster the stream's clock goes than ours, ms per ms; 0 until it is known.
  [[nodiscard]] double drift() const { return drift_; }
  /// Of the newest answer; nullopt before the first.
  [[nodiscard]] std::optional<double> round_trip() const { return round_trip_; }
  /// How often the clocks turned out to have been set, or one of them to have slept.
  [[nodiscard]] std::size_t steps() const { return steps_; }

 private:
  /// The stream's clock minus ours was between these two when ours was at `at`.
  struct Bounds {
    double at = 0, low = 0, high = 0;
  };
  struct Point {
    double at = 0, offset = 0;
  };
  [[nodiscard]] Bounds bounds_at(double local) const;
  void measure_drift();

  std::deque<Bounds> answers_;
  std::deque<Point> past_;  ///< estimates drift_step apart
  Point now_;
  bool known_ = false, answered_ = false;
  double half_width_ = 0, drift_ = 0, heard_at_ = 0;
  std::optional<double> round_trip_;
  std::size_t steps_ = 0;
};

/// ms from one ping to the next: quick at first, since the clock is all but unknown then, and less rare where answers
/// jitter. `sent`: pings sent since the header. `steady`: the longest.
constexpr double ping_pause(std::size_t sent, double uncertainty, double steady = 5000) {
  return sent < 5 ? 200 : sent < 15 ? 1000 : uncertainty > 10 ? 0.4 * steady : steady;
}

}  // namespace semblante::client
