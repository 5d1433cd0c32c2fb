#pragma once

#include <memory>

#include "core/performance/performance.h"
#include "protocol/cpp/quantizers.h"
#include "server/streams/frame_source.h"

namespace semblante::streams {

/// `steps`: of the stream it is played into.
std::shared_ptr<const FrameSource> make_performance_source(Performance performance,
                                                           const QuantizerSteps& steps = standard_quantizers());

/// The minute that the stream `demo` plays: a document of ours, compiled in.
std::shared_ptr<const FrameSource> demo_source();

}  // namespace semblante::streams
