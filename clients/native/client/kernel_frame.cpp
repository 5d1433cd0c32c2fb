#include "clients/native/client/kernel_frame.h"

namespace semblante::client {

semblante_frame to_kernel_frame(const FaceFrame& frame, const QuantizerSteps& steps) {
  semblante_frame out{};
  out.viseme1 = frame.viseme.select1;
  out.viseme2 = frame.viseme.select2;
  out.viseme_blend = frame.viseme.blend;
  out.expression1 = frame.expression.select1;
  out.intensity1 = frame.expression.intensity1;
  out.expression2 = frame.expression.select2;
  out.intensity2 = frame.expression.intensity2;
  for (int fap = first_low_level_fap; fap <= last_low_level_fap; ++fap) {
    const auto f = static_cast<std::size_t>(fap);
    out.fap[f] = static_cast<float>(frame.level[f] * steps[f]);
  }
  return out;
}

}  // namespace semblante::client
