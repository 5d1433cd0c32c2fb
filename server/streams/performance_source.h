#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/performance/performance.h"
#include "protocol/cpp/quantizers.h"
#include "server/streams/frame_source.h"

namespace semblante::streams {

/// Plays a performance. `steps` are the quantizer steps of the stream that plays it; `sound` and `texts`: its
/// packets and sentences, see FrameSource::sound_from() and texts_from().
std::shared_ptr<const FrameSource> make_performance_source(Performance performance,
                                                           const QuantizerSteps& steps = standard_quantizers(),
                                                           std::vector<SoundPacket> sound = {},
                                                           std::vector<SpeechText> texts = {});

/// The source of the stream `demo`: the embedded document of demo_document.h.
std::shared_ptr<const FrameSource> demo_source();

/// Iterates over packets, which outlive the cursor, from the first at or after `ms` on.
std::unique_ptr<SoundCursor> packets_from(std::span<const SoundPacket> packets, double ms);
/// The same of sentences.
std::unique_ptr<TextCursor> texts_after(std::span<const SpeechText> texts, double ms);

}  // namespace semblante::streams
