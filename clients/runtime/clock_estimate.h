#pragma once

#include <cstddef>
#include <optional>

#include "clients/runtime/ring.h"

namespace semblante::runtime {

/// A client's estimate of the stream's clock: its offset from the client's own clock, from the round trips of hello and
/// header and of ping and pong. Times in ms; the client's clock may have any origin but must be steady.
/// protocol/SPEC.md, 7.1; protocol/vectors/clock has traces.
class ClockEstimate {
 public:
  /// Round trips older than this are ignored.
  static constexpr double window = 60'000;
  /// Maximum drift of two clocks beyond the measured drift, ms per ms.
  static constexpr double drift_slack = 300e-6;
  static constexpr double greatest_drift = 500e-6;
  /// Minimum and maximum time over which the drift of the clocks is measured.
  static constexpr double drift_least_span = 120'000;
  static constexpr double drift_span = 600'000;
  static constexpr double drift_step = 30'000;
  /// Maximum time of frames ahead of the stream's clock, as limited by the server.
  static constexpr double farthest_ahead = 10'000;
  /// Round trips kept; beyond it the oldest are dropped. More come only if a caller measures the clock all the time.
  static constexpr std::size_t most_answers = 256;
  /// Without a round trip the earliest arrival within this time is used.
  static constexpr double heard_window = 10'000;

  /// A message sent at `sent` was answered by one received at `received`; in between the stream's clock was at
  /// `media_time`, whole ms.
  void answered(double sent, double received, double media_time);
  /// The newest frame of a message received at `received` has `media_time`. Used until the first answer.
  void heard(double received, double media_time);
  /// Discards all measurements, for another stream or epoch.
  void clear();

  /// The stream's clock when the local one is at `local`; nullopt before the first message.
  [[nodiscard]] std::optional<double> at(double local) const;
  /// Maximum error of the estimate, ms; nullopt before the first answer.
  [[nodiscard]] std::optional<double> uncertainty() const;
  /// Drift of the stream's clock relative to the local one, ms per ms; 0 until it is known.
  [[nodiscard]] double drift() const { return drift_; }
  /// Round trip of the newest answer, ms; nullopt before the first.
  [[nodiscard]] std::optional<double> round_trip() const { return round_trip_; }
  /// Number of detected steps: a clock was set or suspended.
  [[nodiscard]] std::size_t steps() const { return steps_; }

 private:
  /// Bounds of the stream's clock minus the local one when the local one was at `at`.
  struct Bounds {
    double at = 0, low = 0, high = 0;
  };
  struct Point {
    double at = 0, offset = 0;
  };
  [[nodiscard]] Bounds bounds_at(double local) const;
  void measure_drift();

  Ring<Bounds, 64> answers_;
  Ring<Point, 32> past_;  ///< estimates drift_step apart
  Point now_;
  bool known_ = false, answered_ = false;
  double half_width_ = 0, drift_ = 0, heard_at_ = 0;
  std::optional<double> round_trip_;
  std::size_t steps_ = 0;
};

/// Time from one ping to the next, ms: short at first, while the estimate is uncertain, and shorter if the round trips
/// vary. `sent`: number of pings since the header. `steady`: the longest pause.
constexpr double ping_pause(std::size_t sent, double uncertainty, double steady = 5000) {
  return sent < 5 ? 200 : sent < 15 ? 1000 : uncertainty > 10 ? 0.4 * steady : steady;
}

}  // namespace semblante::runtime
