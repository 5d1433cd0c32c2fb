#pragma once

#include <cstdint>

#include "protocol/cpp/messages.h"
#include "server/streams/stream_info.h"

namespace semblante::streams {

/// What clients and recordings are told about a stream, whose newest frame has that sequence number. A field that
/// describes the stream is set here, and nowhere else.
Header stream_header(const StreamInfo& stream, std::uint64_t sequence);

/// The same for one connection: also what it needs to follow the stream. `media_time`: now. `rate`: frames a second of
/// what feeds the stream, 0: unknown.
Header connection_header(const StreamInfo& stream, std::uint64_t sequence, std::uint64_t media_time, double rate,
                         bool recovered, StreamCoding coding);

}  // namespace semblante::streams
