#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>
#include <vector>

#include "core/types/model.h"
#include "core/types/result.h"

namespace semblante::tools {

/// Errors: io, too_large (over 256 MiB).
Result<std::vector<std::uint8_t>> read_file(const std::filesystem::path& path);
Status write_file(const std::filesystem::path& path, std::string_view bytes);

/// Reads and imports a model file; errors name the file in front of what import says.
Result<Model> load_model(const std::filesystem::path& path);

/// "where: message" for a terminal.
std::string to_text(const Error& error);

}  // namespace semblante::tools
