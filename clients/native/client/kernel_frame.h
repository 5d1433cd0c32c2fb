#pragma once

#include "core/kernel/semblante_kernel.h"
#include "protocol/cpp/face_frame.h"
#include "protocol/cpp/quantizers.h"

namespace semblante::client {

/// A frame of a stream -> what the kernel takes: levels times the stream's quantizer steps.
semblante_frame to_kernel_frame(const FaceFrame& frame, const QuantizerSteps& steps);

}  // namespace semblante::client
