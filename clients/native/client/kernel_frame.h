#pragma once

#include "core/kernel/semblante_kernel.h"
#include "protocol/cpp/face_frame.h"
#include "protocol/cpp/quantizers.h"

namespace semblante::client {

/// Converts a frame of a stream to one of the kernel: levels times the stream's quantizer steps.
semblante_frame to_kernel_frame(const FaceFrame& frame, const QuantizerSteps& steps);

}  // namespace semblante::client
