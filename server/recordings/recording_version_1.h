#pragma once

#include <cstdint>
#include <span>

#include "core/types/result.h"
#include "protocol/cpp/messages.h"

namespace semblante::recordings {

/// Reads the frames in files of version 1, which are differences as varints: README.md, "Version 1". Nothing writes
/// them any more.
class Version1Decoder {
 public:
  /// Whether a chunk whose first message begins with `type` is of version 1.
  static bool reads(std::uint8_t type);

  /// Untrusted bytes of one message. Errors: malformed, truncated, out_of_range.
  Result<Keyframe> keyframe(std::span<const std::uint8_t> message);
  /// After keyframe(). At most max_frames_per_message.
  Status frames(std::span<const std::uint8_t> message, Frames& to);

 private:
  FaceFrame last_;
};

}  // namespace semblante::recordings
