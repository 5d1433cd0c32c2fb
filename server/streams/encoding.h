#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "protocol/cpp/messages.h"
#include "protocol/cpp/packed_codec.h"
#include "server/streams/subscriber_list.h"

namespace semblante::streams {

/// A message in binary form, as it goes over a WebSocket.
void append_payload(std::string& wire, const std::vector<std::uint8_t>& payload);

/// One message by itself: not frames in binary form, which say what changed since the one before.
void append_encoded(std::string& wire, const Message& message, bool binary);

/// The newest state of `packed`: where a reader of that form begins.
void append_join_point(std::string& wire, const PackedEncoder& packed, Coding coding);

}  // namespace semblante::streams
