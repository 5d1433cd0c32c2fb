#pragma once

#include <algorithm>
#include <cstdint>

namespace semblante::bench {

/// When a stream that gathers frames meant to send a batch: its batches are due at even distances, and only the phase
/// of these moments is unknown. It is taken from the earliest of the first arrivals. All times in ns.
class BatchGrid {
 public:
  /// 0: nothing is gathered, a batch is due when its newest frame was sent.
  void set_interval(std::int64_t interval) {
    if (interval == interval_) return;
    interval_ = interval;
    restart();
  }
  /// Takes the phase anew, from the next arrivals: those before were of a busier time.
  void restart() { seen_ = 0; }

  /// `arrival`: of the first subscriber that has the batch.
  std::int64_t due(std::int64_t first_frame_sent, std::int64_t last_frame_sent, std::int64_t arrival) {
    if (interval_ == 0) return last_frame_sent;
    if (seen_ < learned) {
      if (seen_++ == 0) phase_ = arrival;
      // Nearest moment of the grid; later than half an interval would look early, and make all others seem later than
      // they are, never earlier.
      const std::int64_t off = modulo(arrival - phase_ + interval_ / 2) - interval_ / 2;
      phase_ += std::min<std::int64_t>(off, 0);
    }
    // However late it comes: no frame is gathered for longer than an interval.
    const std::int64_t latest = std::min(arrival, first_frame_sent + interval_ + slack);
    // A little before its moment is on time: not all of the arrivals that the phase was taken from were prompt.
    const std::int64_t reached = latest + interval_ / 4;
    return reached - modulo(reached - phase_);
  }

 private:
  static constexpr int learned = 20;
  static constexpr std::int64_t slack = 2'000'000;  ///< from the publisher's clock to the server's

  [[nodiscard]] std::int64_t modulo(std::int64_t value) const {
    const std::int64_t rest = value % interval_;
    return rest < 0 ? rest + interval_ : rest;
  }

  std::int64_t interval_ = 0, phase_ = 0;
  int seen_ = 0;
};

}  // namespace semblante::bench
