#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/types/result.h"
#include "protocol/cpp/face_values.h"
#include "protocol/cpp/messages.h"
#include "protocol/cpp/quantizers.h"

namespace semblante {

/// One message as text. FAPs are in FAP units, each frame is whole (there is no delta form in JSON).
std::string encode_json(const Message& message, const QuantizerSteps& steps = standard_quantizers());

/// One message from text. Errors carry the JSON pointer of the member at fault in `where`.
Result<Message> decode_json(std::string_view text, const QuantizerSteps& steps = standard_quantizers());

/// The body of POST /v1/streams/{id}/frames: {"frames": [{"time", "viseme", "expression", "faps"}, ...]}, at least one.
/// `clamped` gets how many of ARKit's coefficients and Oculus's weights were outside 0..1.
Result<std::vector<TimedFrame>> decode_json_frames(std::string_view text,
                                                   const QuantizerSteps& steps = standard_quantizers(),
                                                   std::size_t* clamped = nullptr);

struct JsonValuesLimits {
  std::size_t bytes = std::size_t{64} << 20U;
  std::size_t frames = 100'000;
};

/// The same form as a file: in FAP units as they stand (finite, within +-1e9), not quantized.
Result<std::vector<TimedValues>> decode_json_values(std::string_view text, const JsonValuesLimits& limits = {});
/// One frame of it, without what stands around the list.
std::string encode_json_value(const TimedValues& frame);
/// One frame a line. FAPs that are 0 are left out, and FAPs 1 and 2 that are none.
std::string encode_json_values(std::span<const TimedValues> frames);

}  // namespace semblante
