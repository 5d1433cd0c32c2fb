#include "clients/gateways/net/media_timeline.h"

#include <algorithm>
#include <cmath>

namespace semblante::gateways {

std::uint64_t MediaTimeline::place(std::optional<double> source, double arrival) {
  if (!begin_) begin_ = arrival;
  const double arrived = (arrival - *begin_) * 1000.0 + 1.0;
  double at = arrived;
  const bool is_told = source && std::isfinite(*source) && source != last_source_;
  if (is_told) {
    const double theirs = *source * 1000.0;
    if (!offset_ || std::abs(theirs + *offset_ - arrived) > jump_ms) offset_ = arrived - theirs;
    *offset_ += follow * (arrived - theirs - *offset_);
    at = theirs + *offset_;
  }
  last_source_ = source;
  last_ = std::max(last_, static_cast<std::uint64_t>(std::max(1.0, std::round(at))));
  return last_;
}

}  // namespace semblante::gateways
