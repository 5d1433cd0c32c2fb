#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/types/result.h"
#include "protocol/cpp/messages.h"
#include "protocol/cpp/packed_state.h"

namespace semblante {

/// Encodes the messages of ONE stream in the binary form. It keeps the last frame, because a `frames` message contains
/// only differences: the decoder must receive every message in order, or a keyframe. To encode a keyframe for a single
/// late reader use a separate encoder, `FrameEncoder().encode(keyframe)`.
class FrameEncoder {
 public:
  /// Asserts that the message is within the documented ranges, and that frames follow a keyframe without a gap.
  std::vector<std::uint8_t> encode(const Message& message);
  /// Appends to `to`.
  void encode(const Message& message, std::vector<std::uint8_t>& to);

  /// Drops the last frame: the next state must be a keyframe.
  void reset() { last_.reset(); }

 private:
  std::optional<FaceFrame> last_;
  std::uint64_t last_sequence_ = 0;
};

/// Decodes the messages of ONE stream in the binary form, plain or packed, from untrusted bytes. Both forms give the
/// same messages; frames must have the form of the keyframe before them.
class FrameDecoder {
 public:
  /// Errors: `unsupported` for a message type of a later version (to be skipped), `mismatch` (where "/sequence") for
  /// frames before a keyframe or after a gap (reconnect), other codes for malformed bytes. An error leaves the
  /// decoder's state unchanged.
  Result<Message> decode(std::span<const std::uint8_t> bytes);
  /// The same for a message of which is_packed_frames is true. `to` has no meaning after an error; its memory is used
  /// again, so that frames need none of their own.
  Status decode_frames(std::span<const std::uint8_t> bytes, Frames& to);

  void reset() {
    last_.reset();
    packed_.reset();
  }

 private:
  Result<Message> decode_packed(std::span<const std::uint8_t> bytes);

  std::optional<FaceFrame> last_;  ///< of the plain form
  std::uint64_t last_sequence_ = 0;
  std::optional<PackedState> packed_;
};

}  // namespace semblante
