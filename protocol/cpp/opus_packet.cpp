#include "protocol/cpp/opus_packet.h"

#include <array>

namespace semblante {
namespace {

constexpr double longest_packet = 120.0;  ///< ms

/// Of one frame, by the configuration in the upper five bits of the first byte (RFC 6716, table 2).
double frame_ms(unsigned configuration) {
  constexpr std::array silk = {10.0, 20.0, 40.0, 60.0};
  constexpr std::array hybrid = {10.0, 20.0};
  constexpr std::array celt = {2.5, 5.0, 10.0, 20.0};
  if (configuration < 12) return silk[configuration % 4];
  if (configuration < 16) return hybrid[configuration % 2];
  return celt[configuration % 4];
}

}  // namespace

std::optional<double> opus_packet_ms(std::span<const std::uint8_t> packet) {
  if (packet.empty()) return std::nullopt;
  const unsigned code = packet[0] & 3U;
  if (code == 3 && packet.size() < 2) return std::nullopt;
  const unsigned frames = code == 0 ? 1U : code < 3 ? 2U : packet[1] & 63U;
  const double ms = frames * frame_ms(packet[0] >> 3U);
  return frames == 0 || ms > longest_packet ? std::nullopt : std::optional(ms);
}

Status check_sound(const SoundPacket& sound) {
  if (!opus_packet_ms(sound.packet)) return Error{ErrorCode::malformed, "/packet", "is no Opus packet"};
  return Unit{};
}

}  // namespace semblante
