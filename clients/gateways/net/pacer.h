#pragma once

#include <optional>

namespace semblante::gateways {

/// When frames that come in batches are due, so that they leave as evenly as they were made: as late after their media
/// time as the first frame of the latest batch came, which is the least delay without gaps. The delay falls slowly when
/// batches come earlier again. Times are ms of any clock that does not fall.
class Pacer {
 public:
  static constexpr double fall = 0.01;       ///< ms a ms
  static constexpr double jump_ms = 1000.0;  ///< further apart, the stream's clock was set anew

  /// A batch is here: `first` is the media time of its first frame.
  void arrived(double first, double now);
  /// Of a frame of a batch that arrived.
  [[nodiscard]] double due(double media_time) const { return media_time + delay_.value_or(0.0); }

 private:
  std::optional<double> delay_;
  double last_ = 0.0;
};

}  // namespace semblante::gateways
