#include "protocol/cpp/fap_ranges.h"

#include <algorithm>
#include <cassert>

#include "core/tables/mpeg4.h"
#include "protocol/cpp/quantizers.h"

namespace semblante {

LevelRange level_range(std::size_t fap, double scale) {
  assert(fap >= first_low_level_fap && fap <= last_low_level_fap && is_quantizer_scale(scale));
  const auto& entry = mpeg4::fap(fap);
  const std::int32_t least = entry.bidirectional ? entry.min_level : std::min(entry.min_level, -entry.max_level);
  const auto finer = static_cast<std::int32_t>(1.0 / scale);
  constexpr auto limit = static_cast<std::int32_t>(max_level);
  return {std::max(least * finer, -limit), std::min(entry.max_level * finer, limit)};
}

std::size_t clamp_to_ranges(FaceFrame& frame, double scale) {
  std::size_t clamped = 0;
  for (std::size_t fap = first_low_level_fap; fap <= last_low_level_fap; ++fap) {
    const auto [least, most] = level_range(fap, scale);
    const auto level = static_cast<std::int16_t>(std::clamp<std::int32_t>(frame.level[fap], least, most));
    if (level == frame.level[fap]) continue;
    frame.level[fap] = level;
    ++clamped;
  }
  return clamped;
}

}  // namespace semblante
