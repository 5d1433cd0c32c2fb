#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace semblante::import {

/// "image/png", "image/jpeg", "image/webp" or "image/ktx2" by content, independent of the declared type; empty for
/// anything else.
std::string_view image_type(std::span<const std::uint8_t> bytes);

}  // namespace semblante::import
