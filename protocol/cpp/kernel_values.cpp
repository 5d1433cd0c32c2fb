#include "protocol/cpp/kernel_values.h"

namespace semblante {

FaceValues to_values(const semblante_frame& frame) {
  FaceValues values;
  values.viseme = {frame.viseme1, frame.viseme2, frame.viseme_blend};
  values.expression = {frame.expression1, frame.intensity1, frame.expression2, frame.intensity2};
  for (std::size_t n = first_low_level_fap; n < values.fap.size(); ++n)
    values.fap[n] = static_cast<double>(frame.fap[n]);
  return values;
}

semblante_frame to_kernel_frame(const FaceValues& values) {
  semblante_frame frame{};
  frame.viseme1 = values.viseme.select1;
  frame.viseme2 = values.viseme.select2;
  frame.viseme_blend = values.viseme.blend;
  frame.expression1 = values.expression.select1;
  frame.intensity1 = values.expression.intensity1;
  frame.expression2 = values.expression.select2;
  frame.intensity2 = values.expression.intensity2;
  for (std::size_t n = first_low_level_fap; n < values.fap.size(); ++n)
    frame.fap[n] = static_cast<float>(values.fap[n]);
  return frame;
}

FaceFrame quantized(const semblante_frame& frame, const QuantizerSteps& steps) {
  return to_frame(to_values(frame), steps);
}

}  // namespace semblante
