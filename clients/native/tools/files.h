#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>
#include <vector>

#include "core/types/result.h"

namespace semblante::tools {

/// Errors: io, too_large (over 256 MiB).
Result<std::vector<std::uint8_t>> read_file(const std::filesystem::path& path);
Status write_file(const std::filesystem::path& path, std::string_view bytes);

/// The error with the path of the file prepended to `where`.
Error in_file(const std::filesystem::path& path, Error error);

/// Formats an error as "where: message" for a terminal.
std::string to_text(const Error& error);

}  // namespace semblante::tools
