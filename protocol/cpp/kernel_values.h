#pragma once

#include "core/kernel/semblante_kernel.h"
#include "protocol/cpp/face_values.h"

namespace semblante {

/// Converts between the kernel's frame and FaceValues (to single precision).
FaceValues to_values(const semblante_frame& frame);
semblante_frame to_kernel_frame(const FaceValues& values);

/// Quantizes a frame in FAP units to the nearest levels of a stream, clamped to +-32767.
FaceFrame quantized(const semblante_frame& frame, const QuantizerSteps& steps = standard_quantizers());

}  // namespace semblante
