#include "protocol/cpp/quantized_frame.h"

#include <algorithm>
#include <cmath>

namespace semblante {

FaceFrame quantized(const semblante_frame& frame, const QuantizerSteps& steps) {
  FaceFrame state;
  state.viseme = {frame.viseme1, frame.viseme2, frame.viseme_blend};
  state.expression = {frame.expression1, frame.intensity1, frame.expression2, frame.intensity2};
  constexpr double most = max_level;
  for (std::size_t n = first_low_level_fap; n < state.level.size(); ++n) {
    const double level = std::round(static_cast<double>(frame.fap[n]) / steps[n]);
    state.level[n] = static_cast<std::int16_t>(std::clamp(level, -most, most));
  }
  return state;
}

}  // namespace semblante
