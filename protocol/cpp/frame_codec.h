#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/types/result.h"
#include "protocol/cpp/messages.h"
#include "protocol/cpp/packed_state.h"

namespace semblante {

/// Appends the binary form of a message that carries no face: all but `keyframe` and `frames`, which PackedEncoder
/// makes. Asserts that the message is within the documented ranges.
void encode_message(const Message& message, std::vector<std::uint8_t>& to);

/// Decodes the messages of ONE stream in the binary form from untrusted bytes.
class FrameDecoder {
 public:
  /// Errors: `unsupported` for a message type of a later version (to be skipped), `mismatch` (where "/sequence") for
  /// frames before a keyframe or after a gap (reconnect), other codes for malformed bytes. An error leaves the
  /// decoder's state unchanged.
  Result<Message> decode(std::span<const std::uint8_t> bytes);
  /// The same in a client: messages that only clients send are `unsupported`.
  Result<Message> decode_from_server(std::span<const std::uint8_t> bytes);
  /// The same for a message of which is_frames is true. `to` has no meaning after an error; its memory is used
  /// again, so that frames need none of their own.
  Status decode_frames(std::span<const std::uint8_t> bytes, Frames& to);

  void reset() { state_.reset(); }

 private:
  std::optional<PackedState> state_;  ///< none before the first keyframe
};

}  // namespace semblante
