#pragma once

#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include "protocol/cpp/frame_codec.h"
#include "protocol/cpp/packed_codec.h"

namespace semblante {

/// Encodes all messages of ONE stream in the binary form, as a server or a publisher does. A keyframe begins anew,
/// without the frames before it.
class FrameEncoder {
 public:
  /// Asserts what encode_message and PackedEncoder assert, and that frames follow a keyframe.
  std::vector<std::uint8_t> encode(const Message& message) {
    if (const auto* keyframe = std::get_if<Keyframe>(&message)) return packed_.emplace(*keyframe).keyframe();
    if (const auto* frames = std::get_if<Frames>(&message)) return packed_.value().encode(*frames);
    std::vector<std::uint8_t> bytes;
    encode_message(message, bytes);
    return bytes;
  }

 private:
  std::optional<PackedEncoder> packed_;
};

}  // namespace semblante
