#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/types/result.h"
#include "protocol/cpp/messages.h"
#include "protocol/cpp/quantizers.h"

namespace semblante {

/// One message as text. FAPs are in FAP units, each frame is whole (there is no delta form in JSON).
std::string encode_json(const Message& message, const QuantizerSteps& steps = standard_quantizers());

/// One message from text. Errors carry the JSON pointer of the member at fault in `where`.
Result<Message> decode_json(std::string_view text, const QuantizerSteps& steps = standard_quantizers());

/// The body of POST /v1/streams/{id}/frames: {"frames": [{"time", "viseme", "expression", "faps"}, ...]}, at least one.
Result<std::vector<TimedFrame>> decode_json_frames(std::string_view text,
                                                   const QuantizerSteps& steps = standard_quantizers());

}  // namespace semblante
