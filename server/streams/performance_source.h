#pragma once

#include <memory>

#include "core/performance/performance.h"
#include "protocol/cpp/quantizers.h"
#include "server/streams/frame_source.h"

namespace semblante::streams {

/// Plays a performance. `steps` are the quantizer steps of the stream that plays it.
std::shared_ptr<const FrameSource> make_performance_source(Performance performance,
                                                           const QuantizerSteps& steps = standard_quantizers());

/// The source of the stream `demo`: the embedded document of demo_document.h.
std::shared_ptr<const FrameSource> demo_source();

}  // namespace semblante::streams
