#pragma once

#include <optional>

namespace semblante::gateways {

/// Computes the due times of frames that arrive in batches, so that they are sent with even spacing. The delay after
/// the media time is the largest lateness of the first frame of a batch, the smallest delay without gaps. It decreases
/// slowly when batches arrive earlier again. Times are ms of any monotonic clock.
class Pacer {
 public:
  static constexpr double fall = 0.01;       ///< decrease of the delay, ms per ms
  static constexpr double jump_ms = 1000.0;  ///< larger differences mean that the stream's clock was reset

  /// A batch has arrived: `first` is the media time of its first frame.
  void arrived(double first, double now);
  /// The due time of a frame of an arrived batch.
  [[nodiscard]] double due(double media_time) const { return media_time + delay_.value_or(0.0); }

 private:
  std::optional<double> delay_;
  double last_ = 0.0;
};

}  // namespace semblante::gateways
