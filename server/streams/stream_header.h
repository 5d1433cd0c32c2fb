#pragma once

#include <cstdint>

#include "protocol/cpp/messages.h"
#include "server/streams/stream_info.h"

namespace semblante::streams {

/// The header of a stream for clients and recordings; `sequence` is that of its newest frame. All fields that describe
/// the stream are set here.
Header stream_header(const StreamInfo& stream, std::uint64_t sequence);

/// The same for one connection, with the members that it needs to follow the stream. `media_time`: now. `rate`: frames
/// per second of the current source, 0: unknown. `sound`: whether this connection asked for it.
Header connection_header(const StreamInfo& stream, std::uint64_t sequence, std::uint64_t media_time, double rate,
                         bool recovered, bool sound);

/// The sound that every stream can have. Its packets are made by voice/sound_coder.h.
inline constexpr SoundTrack stream_sound = {SoundCodec::opus, 48'000, 1, 20'000};

}  // namespace semblante::streams
