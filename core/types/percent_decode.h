#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace semblante {

/// Decodes the percent codes of a part of a URI. '+' stays '+' unless `plus_is_space`. nullopt for a broken code and
/// for a NUL byte, coded or not.
std::optional<std::string> percent_decode(std::string_view text, bool plus_is_space = false);

}  // namespace semblante
