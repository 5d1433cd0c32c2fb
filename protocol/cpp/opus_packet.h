#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "core/types/result.h"
#include "protocol/cpp/messages.h"

namespace semblante {

/// How long an Opus packet lasts, ms, by its first two bytes (RFC 6716, sections 3.1 and 3.2); nullopt for bytes that
/// are no packet: none at all, no frame in it, or more than 120 ms.
std::optional<double> opus_packet_ms(std::span<const std::uint8_t> packet);

/// `malformed` at /packet unless it is an Opus packet.
Status check_sound(const SoundPacket& sound);

}  // namespace semblante
