#pragma once

#include <cstdint>
#include <vector>

#include "protocol/cpp/messages.h"

namespace semblante::testing {

/// Keyframes and frames as differences in varints, the form in recordings of version 1
/// (server/recordings/README.md, "Version 1"). Only tests and benchmarks write it.
std::vector<std::uint8_t> varint_keyframe(const Keyframe& keyframe);
/// `before`: the face that the first frame is a difference to.
std::vector<std::uint8_t> varint_frames(const Frames& frames, const FaceFrame& before);

}  // namespace semblante::testing
