#pragma once

#include <memory>
#include <string>

#include "protocol/cpp/quantizers.h"
#include "server/recordings/recording_reader.h"
#include "server/streams/frame_source.h"

namespace semblante::recordings {

/// A recording to be played: every frame at its own time. It is read into memory whole (no disk while it plays), still
/// encoded. `steps`: of the stream it is played into; where the recording has others, levels go to the nearest.
/// Errors: empty (no frames), and what is wrong with a chunk.
Result<std::shared_ptr<const streams::FrameSource>> make_recording_source(
    const ByteSource& bytes, std::string name, const QuantizerSteps& steps = standard_quantizers());

}  // namespace semblante::recordings
