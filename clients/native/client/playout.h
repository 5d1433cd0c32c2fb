#pragma once

#include <cstdint>
#include <deque>
#include <limits>
#include <optional>

#include "clients/native/client/clock_estimate.h"
#include "protocol/cpp/messages.h"

namespace semblante::client {

struct PlayoutOptions {
  /// ms behind the stream's clock, whatever the network does; without it the delay adapts to how late frames come.
  std::optional<double> delay;
  /// One frame more is wanted beyond the shown moment: a curve has to know where it goes after the pair it is in.
  bool eased = false;
};

/// How a playout goes. Times in ms.
struct PlayoutStats {
  double delay = 0;         ///< behind the stream's clock now
  double wanted_delay = 0;  ///< where it is going
  double jitter = 0;        ///< mean change from one arrival to the next (RFC 3550)
  double error = 0;         ///< what is shown minus what should be, by our own estimate; below 0 while held
  std::uint64_t starved = 0, snaps = 0;
  double starved_time = 0;
};

/// Which media time to show when: the stream's clock less a delay that frames need to be there in time, at a speed that
/// changes by little, never back. Knows times only. Times in ms, "now" is of the client's clock.
/// protocol/SPEC.md, 7.2; clients/js/playout.ts is the same, and protocol/vectors/clock holds the two together.
class Playout {
 public:
  static constexpr double max_speed_change = 0.05;
  /// Of that, for the delay's sake.
  static constexpr double delay_rate = 0.04;
  /// In which an error is played away, as far as the speed allows.
  static constexpr double correction_time = 1000;
  /// Farther behind than this it jumps.
  static constexpr double snap_threshold = 500;
  static constexpr double least_delay = 60;
  static constexpr double greatest_delay = 2000;
  /// Added to the lateness that is to be waited for.
  static constexpr double margin = 15;
  /// Lateness is kept as the worst of each second for this many of them; the second worst of those counts, and in the
  /// first few seconds the worst.
  static constexpr std::int64_t seconds_kept = 60;
  static constexpr std::size_t seconds_for_second_worst = 5;
  /// Frames farther apart than this, or than 2.5 frames of a slow stream, have a rest between them.
  static constexpr double least_rest = 250;
  /// After a rest the motion towards the next frame takes this long, if it arrives in time.
  static constexpr double motion_after_rest = 100;

  explicit Playout(const PlayoutOptions& options = {}) : options_(options) {}

  ClockEstimate& clock() { return clock_; }
  [[nodiscard]] const ClockEstimate& clock() const { return clock_; }

  /// A header came, at first or after a lost connection. Another epoch is another time line: true if so.
  bool begin(const Header& header);
  /// Frames came: the media times of the first and the last, and of the one before the last (equal to the first when
  /// there is one only). Frames at or before the newest known are not to be given. Returns the media time at which the
  /// motion towards the first of them begins: mostly that of the frame before.
  double arrived(double first, double before_last, double last, double now);
  /// Moves on by a display frame that is shown `elapsed` after the one before.
  void advance(double now, double elapsed);
  /// Shows this moment, as far as frames go: another clock leads, such as the sound's. Back only from farther than the
  /// snap threshold.
  void move_to(double media_time);
  /// Forgets the frames; the clock stays.
  void clear();

  /// Media time to show, ms; NaN before the first frame.
  [[nodiscard]] double playhead() const { return playhead_; }
  [[nodiscard]] double newest() const { return newest_; }
  [[nodiscard]] double delay() const { return delay_; }
  [[nodiscard]] PlayoutStats stats() const { return stats_; }

 private:
  struct Second {
    std::int64_t number = 0;
    double worst = 0;
  };
  [[nodiscard]] double first_delay() const;
  [[nodiscard]] double rest() const;
  void count_lateness(double lateness, double now);
  void measure_jitter(double transit);
  void measure_interval(double gap);

  PlayoutOptions options_;
  ClockEstimate clock_;
  std::optional<std::uint64_t> epoch_;
  double message_interval_ = 0, frame_interval_ = 0;  ///< as the header says; 0: unknown
  double measured_interval_ = 0;                      ///< between frames
  double history_until_ = 0;  ///< what is older than this was sent before we were there: its lateness says nothing
  double playhead_ = std::numeric_limits<double>::quiet_NaN();
  double newest_ = std::numeric_limits<double>::quiet_NaN();
  double before_newest_ = std::numeric_limits<double>::quiet_NaN();
  double transit_ = std::numeric_limits<double>::quiet_NaN();
  double delay_ = std::numeric_limits<double>::quiet_NaN();
  double wanted_delay_ = std::numeric_limits<double>::quiet_NaN();
  std::deque<Second> seconds_;
  PlayoutStats stats_;
};

}  // namespace semblante::client
