#pragma once

#include <optional>

namespace semblante::gateways {

/// Computes when frames that arrive in batches are due, so that they are sent with even spacing: with the delay after
/// their media time of the first frame of the latest batch, which is the smallest delay without gaps. The delay
/// decreases slowly when batches arrive earlier again. Times are ms of any monotonic clock.
class Pacer {
 public:
  static constexpr double fall = 0.01;       ///< ms a ms
  static constexpr double jump_ms = 1000.0;  ///< larger differences mean that the stream's clock was reset

  /// A batch has arrived: `first` is the media time of its first frame.
  void arrived(double first, double now);
  /// When a frame of an arrived batch is due.
  [[nodiscard]] double due(double media_time) const { return media_time + delay_.value_or(0.0); }

 private:
  std::optional<double> delay_;
  double last_ = 0.0;
};

}  // namespace semblante::gateways
