#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "protocol/cpp/messages.h"
#include "protocol/cpp/packed_codec.h"
#include "protocol/cpp/quantizers.h"
#include "server/streams/subscriber_list.h"

namespace semblante::streams {

/// A message in binary form, as it goes over a WebSocket.
void append_payload(std::string& wire, const std::vector<std::uint8_t>& payload);

/// One message by itself: not frames in binary form, which say what changed since the one before. `steps`: the
/// stream's; levels become FAP units in JSON.
void append_encoded(std::string& wire, const Message& message, bool binary, const QuantizerSteps& steps);

/// The newest state of `packed`: where a reader of that form begins.
void append_join_point(std::string& wire, const PackedEncoder& packed, Coding coding, const QuantizerSteps& steps);

}  // namespace semblante::streams
