#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace semblante {

/// A SHA-256 hash as its 32 bytes. The protocol does not compute hashes.
using Sha256 = std::array<std::uint8_t, 32>;

/// 64 lower-case hexadecimal digits.
std::string to_hex(const Sha256& hash);
/// Parses exactly 64 hexadecimal digits (either case); else nullopt.
std::optional<Sha256> parse_sha256(std::string_view hex);

}  // namespace semblante
