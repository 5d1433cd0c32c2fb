#pragma once

#include <memory>
#include <string>

#include "protocol/cpp/quantizers.h"
#include "server/recordings/recording_reader.h"
#include "server/streams/frame_source.h"

namespace semblante::recordings {

/// Plays a recording, every frame at its own time. The recording is read into memory completely, still encoded, so that
/// playing needs no disk. `steps`: of the stream it is played into; if the recording has others, levels are rounded to
/// the nearest. Errors: empty (no frames), and those of a damaged chunk.
Result<std::shared_ptr<const streams::FrameSource>> make_recording_source(
    const std::shared_ptr<const ByteSource>& bytes, std::string name,
    const QuantizerSteps& steps = standard_quantizers());

}  // namespace semblante::recordings
