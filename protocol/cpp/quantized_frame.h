#pragma once

#include "core/kernel/semblante_kernel.h"
#include "protocol/cpp/face_frame.h"
#include "protocol/cpp/quantizers.h"

namespace semblante {

/// A frame in FAP units -> the levels of a stream, rounded to nearest; what is beyond +-32767 levels becomes that.
FaceFrame quantized(const semblante_frame& frame, const QuantizerSteps& steps = standard_quantizers());

}  // namespace semblante
