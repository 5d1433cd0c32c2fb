#pragma once

#include <cstdint>
#include <optional>

namespace semblante::gateways {

/// Places what a sender says at its own clock on one time line that does not fall: the sender's spacing is kept, so
/// that a jittery network makes no jittery face. The line follows the clock of arrival slowly, and is set to it at once
/// where the two are more than `jump_ms` apart: a sender that was started again, slept, or passed midnight.
class MediaTimeline {
 public:
  static constexpr double jump_ms = 500.0;
  static constexpr double follow = 0.002;  ///< of the distance to the clock of arrival, each frame

  /// `source`: seconds of the sender's clock, if it told them; `arrival`: seconds of ours. ms, at least 1.
  std::uint64_t place(std::optional<double> source, double arrival);

 private:
  std::optional<double> begin_;        ///< arrival of the first frame, seconds
  std::optional<double> last_source_;  ///< a clock that stands is none
  std::optional<double> offset_;       ///< ms, from the sender's clock to the line
  std::uint64_t last_ = 0;
};

}  // namespace semblante::gateways
