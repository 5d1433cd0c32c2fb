#include "protocol/cpp/fap_ranges.h"

#include <algorithm>
#include <cassert>

#include "core/tables/mpeg4.h"

namespace semblante {

LevelRange level_range(std::size_t fap) {
  assert(fap >= first_low_level_fap && fap <= last_low_level_fap);
  const auto& entry = mpeg4::fap(fap);
  return {entry.bidirectional ? entry.min_level : std::min(entry.min_level, -entry.max_level), entry.max_level};
}

std::size_t clamp_to_ranges(FaceFrame& frame) {
  std::size_t clamped = 0;
  for (std::size_t fap = first_low_level_fap; fap <= last_low_level_fap; ++fap) {
    const auto [least, most] = level_range(fap);
    const auto level = static_cast<std::int16_t>(std::clamp<std::int32_t>(frame.level[fap], least, most));
    if (level == frame.level[fap]) continue;
    frame.level[fap] = level;
    ++clamped;
  }
  return clamped;
}

}  // namespace semblante
