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

/// Encodes one message as text. FAPs are in FAP units, frames are complete states (JSON has no delta form).
std::string encode_json(const Message& message, const QuantizerSteps& steps = standard_quantizers());

/// Decodes one message. Errors have the JSON pointer of the invalid member in `where`.
Result<Message> decode_json(std::string_view text, const QuantizerSteps& steps = standard_quantizers());

/// The body of POST /v1/streams/{id}/frames: {"frames": [{"time", "viseme", "expression", "faps"}, ...]}, at least one.
/// `clamped` receives the number of ARKit coefficients and Oculus weights outside 0..1.
Result<std::vector<TimedFrame>> decode_json_frames(std::string_view text,
                                                   const QuantizerSteps& steps = standard_quantizers(),
                                                   std::size_t* clamped = nullptr);

struct JsonValuesLimits {
  std::size_t bytes = std::size_t{64} << 20U;
  std::size_t frames = 100'000;
};

/// Decodes the same form from a file: values in FAP units (finite, within +-1e9), not quantized.
Result<std::vector<TimedValues>> decode_json_values(std::string_view text, const JsonValuesLimits& limits = {});
/// One frame of such a file, without the surrounding list.
std::string encode_json_value(const TimedValues& frame);
/// The file with one frame per line. Omits FAPs that are 0, and FAPs 1 and 2 that are none.
std::string encode_json_values(std::span<const TimedValues> frames);

}  // namespace semblante
