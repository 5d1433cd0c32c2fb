#pragma once

#include <memory>
#include <span>
#include <string>

#include "protocol/cpp/face_values.h"
#include "protocol/cpp/quantizers.h"
#include "server/streams/frame_source.h"

namespace semblante::streams {

/// The faces of a .fap file, `rate` of them a second; between two of them values go linearly. `frames`: at least one.
/// `steps`: of the stream it is played into.
std::shared_ptr<const FrameSource> make_fap_source(std::span<const TimedValues> frames, double rate, std::string name,
                                                   const QuantizerSteps& steps = standard_quantizers());

}  // namespace semblante::streams
