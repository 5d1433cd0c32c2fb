#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace semblante::import {

/// Resolves a relative URI of a file in `folder` ("" or "a/b/", relative to a top folder): decodes percent codes,
/// resolves
/// "." and "..". nullopt for anything outside the top folder: schemes, absolute paths, backslashes, ".." above the top.
std::optional<std::string> resolve_below(std::string_view folder, std::string_view uri);

}  // namespace semblante::import
