#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace semblante {

/// A SHA-256 as its 32 bytes. Who computes it is not the protocol's business.
using Sha256 = std::array<std::uint8_t, 32>;

/// 64 lower-case hexadecimal digits.
std::string to_hex(const Sha256& hash);
/// The reverse; nullopt unless it is exactly 64 hexadecimal digits (either case).
std::optional<Sha256> parse_sha256(std::string_view hex);

}  // namespace semblante
