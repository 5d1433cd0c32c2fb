#include "protocol/cpp/face_values.h"

#include <algorithm>
#include <cmath>

namespace semblante {

FaceValues to_values(const FaceFrame& frame, const QuantizerSteps& steps) {
  FaceValues values{frame.viseme, frame.expression, {}};
  for (std::size_t fap = first_low_level_fap; fap <= last_low_level_fap; ++fap) {
    values.fap[fap] = frame.level[fap] * steps[fap];
  }
  return values;
}

FaceFrame to_frame(const FaceValues& values, const QuantizerSteps& steps) {
  constexpr double most = max_level;
  FaceFrame frame{values.viseme, values.expression, {}};
  for (std::size_t fap = first_low_level_fap; fap <= last_low_level_fap; ++fap) {
    frame.level[fap] = static_cast<std::int16_t>(std::clamp(std::round(values.fap[fap] / steps[fap]), -most, most));
  }
  return frame;
}

}  // namespace semblante
