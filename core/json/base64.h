#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace semblante {

/// RFC 4648, section 4: with padding.
std::string to_base64(std::span<const std::uint8_t> bytes);
/// nullopt for anything that to_base64() does not write.
std::optional<std::vector<std::uint8_t>> from_base64(std::string_view text);

}  // namespace semblante
