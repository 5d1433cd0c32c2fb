#pragma once

#include <memory>
#include <span>
#include <string>

#include "protocol/cpp/face_values.h"
#include "protocol/cpp/quantizers.h"
#include "server/streams/frame_source.h"

namespace semblante::streams {

/// Plays the frames of a .fap file, `rate` per second, with linear interpolation between them. There must be at least
/// one frame. `steps` are the quantizer steps of the stream that plays it.
std::shared_ptr<const FrameSource> make_fap_source(std::span<const TimedValues> frames, double rate, std::string name,
                                                   const QuantizerSteps& steps = standard_quantizers());

}  // namespace semblante::streams
