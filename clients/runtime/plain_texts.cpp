#include "protocol/cpp/packed_text.h"

namespace semblante {

/// In the module of streams: pages unpack texts in that of speakers before this one sees them, so that who does not ask
/// for text does not load the model.
Result<SpeechText> read_packed_text(std::span<const std::uint8_t> /*bytes*/) {
  return Error{ErrorCode::malformed, "/text", "is no packed text"};
}

}  // namespace semblante
