#include "clients/native/client/kernel_frame.h"

#include "protocol/cpp/kernel_values.h"

namespace semblante::client {

semblante_frame to_kernel_frame(const FaceFrame& frame, const QuantizerSteps& steps) {
  return semblante::to_kernel_frame(to_values(frame, steps));
}

}  // namespace semblante::client
