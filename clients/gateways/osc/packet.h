#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <variant>
#include <vector>

#include "core/types/result.h"

namespace semblante::osc {

/// Values of skipped types: nil, infinitum, MIDI.
struct Nothing {
  friend bool operator==(const Nothing&, const Nothing&) = default;
};
/// NTP time: seconds since 1900 in the upper 32 bits, their fraction in the lower.
struct TimeTag {
  std::uint64_t ntp = 0;
  friend bool operator==(const TimeTag&, const TimeTag&) = default;
};
using Blob = std::span<const std::uint8_t>;
/// By type tag: i c r -> int32; f -> float; s S -> text; b -> blob; T F -> bool; h -> int64; d -> double; t -> time;
/// N I m -> nothing. Numbers are unchanged, including NaN and infinity.
using Argument =
    std::variant<std::int32_t, float, std::string_view, Blob, bool, std::int64_t, double, TimeTag, Nothing>;

/// Text and blobs point into the packet.
struct Message {
  std::string_view address;  ///< begins with '/'
  std::vector<Argument> arguments;
};

struct Packet {
  bool is_bundle = false;
  std::vector<Message> messages;  ///< of the bundle and the bundles in it, in their order; time tags are not kept
};

inline constexpr std::size_t max_packet_bytes = 65'507;  ///< what UDP over IPv4 can carry
inline constexpr std::size_t max_bundle_depth = 8;
inline constexpr std::size_t max_arguments = 64;

/// One complete UDP packet of Open Sound Control 1.0. Accepts any bytes. A message without type tags (old senders) must
/// end there: it has no arguments. Elements of arrays ([ and ]) are read as separate arguments. Errors have the byte:
/// truncated, malformed (padding that is not zero, no address, invalid tags), too_large (a limit above).
Result<Packet> read_packet(std::span<const std::uint8_t> bytes);

}  // namespace semblante::osc
