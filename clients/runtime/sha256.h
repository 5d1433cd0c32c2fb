#pragma once

#include <cstdint>
#include <span>

#include "protocol/cpp/sha256.h"

namespace semblante::runtime {

/// SHA-256 (FIPS 180-4) without a library: protocol/hash uses OpenSSL, which phones and browsers would have to carry.
Sha256 sha256(std::span<const std::uint8_t> bytes);

}  // namespace semblante::runtime
