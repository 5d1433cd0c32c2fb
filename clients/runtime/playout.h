#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "clients/runtime/clock_estimate.h"
#include "clients/runtime/ring.h"
#include "protocol/cpp/messages.h"

namespace semblante::runtime {

struct PlayoutOptions {
  /// Fixed delay behind the stream's clock, ms; empty: the delay adapts to the lateness of frames.
  std::optional<double> delay;
  /// Requires one more frame after the shown time, because a curve needs the frame after the current pair.
  bool eased = false;
};

/// The state of a playout. Times in ms.
struct PlayoutStats {
  double delay = 0;         ///< current delay behind the stream's clock
  double wanted_delay = 0;  ///< target of the delay
  double jitter = 0;        ///< mean change from one arrival to the next (RFC 3550)
  double error = 0;         ///< shown minus wanted media time, by the client's estimate; below 0 while held
  std::uint64_t starved = 0, snaps = 0;
  double starved_time = 0;
};

/// Computes the media time to show: the stream's clock minus a delay that is long enough for frames to arrive in time.
/// The shown time advances at a nearly constant speed and never backwards. Uses only times, in ms; `now` is the
/// client's clock. protocol/SPEC.md, 7.2; protocol/vectors/clock has traces.
class Playout {
 public:
  static constexpr double max_speed_change = 0.05;
  /// Part of max_speed_change that may be used to change the delay.
  static constexpr double delay_rate = 0.04;
  /// Time in which an error is corrected, within the limits of the speed.
  static constexpr double correction_time = 1000;
  /// A larger lag causes a jump.
  static constexpr double snap_threshold = 500;
  static constexpr double least_delay = 60;
  static constexpr double greatest_delay = 2000;
  /// Margin added to the expected lateness.
  static constexpr double margin = 15;
  /// The maximum lateness of each second is kept for this many seconds; the second largest is used, in the first few
  /// seconds the largest.
  static constexpr std::int64_t seconds_kept = 60;
  static constexpr std::size_t seconds_for_second_worst = 5;
  /// Frames farther apart than this, or than 2.5 frames of a slow stream, have a rest (no motion) between them.
  static constexpr double least_rest = 250;
  /// After a rest the motion towards the next frame takes this long, if it arrives in time.
  static constexpr double motion_after_rest = 100;

  explicit Playout(const PlayoutOptions& options = {}) : options_(options) {}
  Playout(const Playout&) = delete;
  Playout& operator=(const Playout&) = delete;

  /// The estimate of the stream's clock: its own, or that of a stream, which must outlive its use.
  ClockEstimate& clock() { return *clock_; }
  [[nodiscard]] const ClockEstimate& clock() const { return *clock_; }
  /// Null: its own, from nothing.
  void use_clock(ClockEstimate* clock);

  /// A header was received, at first or after a lost connection. Returns true for another epoch, which has another
  /// timeline.
  bool begin(const Header& header);
  /// Frames were received: the media times of the first and the last, and of the one before the last (equal to the
  /// first when there is one only). Frames at or before the newest known one must not be passed. Returns the media time
  /// at which the motion towards the first of them begins: mostly that of the frame before.
  double arrived(double first, double before_last, double last, double now);
  /// Advances by a display frame that is shown `elapsed` after the one before.
  void advance(double now, double elapsed);
  /// Moves to this time, limited by the received frames: for an external clock, such as that of sound. Backwards only
  /// beyond the snap threshold. The delay, by which that clock may begin anew, then moves as frames arrive.
  void move_to(double media_time);
  /// Drops the frames; keeps the clock.
  void clear();

  /// Media time to show, ms; NaN before the first frame.
  [[nodiscard]] double playhead() const { return playhead_; }
  [[nodiscard]] double newest() const { return newest_; }
  [[nodiscard]] double delay() const { return delay_; }
  [[nodiscard]] PlayoutStats stats() const;

 private:
  struct Second {
    std::int64_t number = 0;
    double worst = 0;
  };
  [[nodiscard]] double first_delay() const;
  [[nodiscard]] double rest() const;
  void count_lateness(double lateness, double now);
  /// Moves the delay towards its target. Returns by how much.
  double move_delay(double elapsed);
  void measure_jitter(double transit);
  void measure_interval(double gap);

  PlayoutOptions options_;
  ClockEstimate own_clock_;
  ClockEstimate* clock_ = &own_clock_;
  std::optional<std::uint64_t> epoch_;
  double message_interval_ = 0, frame_interval_ = 0;  ///< from the header; 0: unknown
  double measured_interval_ = 0;                      ///< between frames
  double history_until_ = 0;  ///< older frames were sent before this client connected: their lateness is not used
  double playhead_ = std::numeric_limits<double>::quiet_NaN();
  double newest_ = std::numeric_limits<double>::quiet_NaN();
  double before_newest_ = std::numeric_limits<double>::quiet_NaN();
  double transit_ = std::numeric_limits<double>::quiet_NaN();
  double delay_ = std::numeric_limits<double>::quiet_NaN();
  double wanted_delay_ = std::numeric_limits<double>::quiet_NaN();
  bool is_moved_ = false;  ///< an external clock moves the playhead
  double arrived_at_ = std::numeric_limits<double>::quiet_NaN();
  Ring<Second, 64> seconds_;
  PlayoutStats stats_;  ///< without the delays
};

}  // namespace semblante::runtime
