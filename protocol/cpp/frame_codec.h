#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/types/result.h"
#include "protocol/cpp/messages.h"
#include "protocol/cpp/packed_state.h"

namespace semblante {

/// Writes the messages of ONE stream in the binary form. It remembers the last frame, because a `frames` message says
/// only what changed: every message it makes must reach the decoder, in order, or a keyframe must follow. A keyframe
/// for one late reader comes from an encoder of its own, `FrameEncoder().encode(keyframe)`.
class FrameEncoder {
 public:
  /// Asserts that the message is within the documented ranges, and that frames follow a keyframe without a gap.
  std::vector<std::uint8_t> encode(const Message& message);

  /// Forgets the last frame: the next state must be a keyframe.
  void reset() { last_.reset(); }

 private:
  std::optional<FaceFrame> last_;
  std::uint64_t last_sequence_ = 0;
};

/// Reads the messages of ONE stream in the binary form, plain or packed; takes any bytes. Both give the same messages;
/// frames must be of the form of the keyframe before them.
class FrameDecoder {
 public:
  /// Errors: `unsupported` for a message type of a later version (skip it), `mismatch` (where "/sequence") for frames
  /// before a keyframe or after a gap (ask again by reconnecting), else what is wrong with the bytes. After an error
  /// the decoder's state is what it was before the message.
  Result<Message> decode(std::span<const std::uint8_t> bytes);

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
