#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "core/bridges/arkit.h"
#include "core/bridges/head_turn.h"
#include "core/types/result.h"

namespace semblante::livelink {

/// A face as seen by ARKit. The angles of the eyes are redundant to the coefficients and are dropped.
struct SeenFace {
  ArkitCoefficients coefficients{};  ///< unchanged from the packet; finite
  HeadTurn head;
};

struct Packet {
  std::string device, subject;  ///< UTF-8
  std::optional<double>
      seconds;                   ///< of the device's clock: its timecode, frames and their fraction divided by the rate
  double rate = 0.0;             ///< frames per second; 0: not stated
  std::optional<SeenFace> face;  ///< empty: the device sees no face
};

inline constexpr std::size_t max_name_bytes = 256;  ///< of device and subject, each
inline constexpr std::size_t max_packet_bytes = 1 + 2 * (4 + max_name_bytes) + 16 + 1 + std::size_t{61} * 4;

/// One UDP packet of Live Link Face, version 6. All numbers are big-endian:
///
///     u8 6; u32 length, device id; u32 length, subject name;
/// i32 frame, f32 fraction of a frame, i32 and i32 frames per second (numerator, denominator);
///     u8 61; 61 f32: ARKit's coefficients in the order of arkit.h, then yaw, pitch, roll of head, left eye, right eye
///
/// If a packet ends after the subject or after the rate, or has 0 values, the device sees no face. Errors name the
/// byte: unsupported (another version), truncated, too_large (a name), malformed (text that is not UTF-8, another
/// number of values, bytes after the last value), out_of_range (an invalid rate), not_finite.
Result<Packet> read_packet(std::span<const std::uint8_t> bytes);

}  // namespace semblante::livelink
