#pragma once

#include <cstdint>
#include <optional>

namespace semblante::gateways {

/// Maps the times of a sender's clock to one monotonic timeline: the sender's spacing is kept, so that network jitter
/// does not become visible. The timeline follows the clock of arrival slowly, and is reset to it when the two differ by
/// more than `jump_ms`: the sender was restarted, slept, or passed midnight.
class MediaTimeline {
 public:
  static constexpr double jump_ms = 500.0;
  static constexpr double follow = 0.002;  ///< fraction of the difference to the clock of arrival, per frame

  /// `source`: seconds of the sender's clock, if known; `arrival`: seconds of the local clock. Returns ms, at least 1.
  std::uint64_t place(std::optional<double> source, double arrival);

 private:
  std::optional<double> begin_;        ///< arrival of the first frame, seconds
  std::optional<double> last_source_;  ///< a clock that has stopped is ignored
  std::optional<double> offset_;       ///< ms, from the sender's clock to the timeline
  std::uint64_t last_ = 0;
};

}  // namespace semblante::gateways
