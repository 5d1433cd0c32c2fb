#include "protocol/cpp/performance_frames.h"

#include <cassert>
#include <cmath>
#include <string>

#include "protocol/cpp/kernel_values.h"

namespace semblante {

Result<std::vector<TimedValues>> frames_of(const Performance& performance, double rate, std::size_t most) {
  assert(rate > 0.0);
  if (performance.endless())
    return Error{ErrorCode::missing, "/duration", "is required here: nothing but idle life has no end"};
  const double count = std::floor(performance.duration() * rate / 1000.0) + 1.0;
  if (count > static_cast<double>(most))
    return Error{ErrorCode::too_large, "/duration", "gives more than " + std::to_string(most) + " frames at this rate"};
  std::vector<TimedValues> frames;
  frames.reserve(static_cast<std::size_t>(count));
  for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) {
    const double ms = static_cast<double>(k) * 1000.0 / rate;
    frames.push_back({static_cast<std::uint32_t>(std::lround(ms)), to_values(performance.frame_at(ms))});
  }
  return frames;
}

}  // namespace semblante
