#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/types/result.h"

namespace semblante::voice {

inline constexpr double packet_ms = 60.0;                ///< how long each packet lasts
inline constexpr std::uint32_t packet_bitrate = 20'000;  ///< bit/s, of voiced sound

/// Sound of one channel as Opus packets (RFC 6716) for the messages `sound` of a stream. What is decoded of packet i
/// begins at i * packet_ms of the samples: the delay of the coder is taken out, and its first milliseconds with it. An
/// empty packet is not sent: nothing is heard in it. Takes 9 ms of processor time for each second of sound. Errors:
/// `out_of_range`, a sample rate outside 8,000 to 48,000 Hz; `internal`, the library's.
Result<std::vector<std::vector<std::uint8_t>>> sound_packets(std::span<const std::int16_t> samples,
                                                             std::uint32_t sample_rate);

}  // namespace semblante::voice
