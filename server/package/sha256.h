#pragma once

#include <cstdint>
#include <span>

#include "protocol/cpp/sha256.h"

namespace semblante {

/// SHA-256 of `bytes` (FIPS 180-4): the name of every artefact.
Sha256 sha256(std::span<const std::uint8_t> bytes);

}  // namespace semblante
