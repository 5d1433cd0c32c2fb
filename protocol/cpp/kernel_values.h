#pragma once

#include "core/kernel/semblante_kernel.h"
#include "protocol/cpp/face_values.h"

namespace semblante {

/// The kernel's frame as files and tools have it, and back (to single precision).
FaceValues to_values(const semblante_frame& frame);
semblante_frame to_kernel_frame(const FaceValues& values);

/// A frame in FAP units -> the levels of a stream, rounded to nearest; what is beyond +-32767 levels becomes that.
FaceFrame quantized(const semblante_frame& frame, const QuantizerSteps& steps = standard_quantizers());

}  // namespace semblante
