#include "server/cli/folder_resources.h"

#include <algorithm>
#include <filesystem>
#include <optional>

#include "core/import/relative_path.h"
#include "core/import/text.h"
#include "server/cli/command_failure.h"
#include "server/cli/files.h"

namespace semblante {
namespace {

namespace fs = std::filesystem;

/// The regular file at `uri` inside `folder`, links followed; nullopt when there is none inside it.
std::optional<fs::path> file_inside(const fs::path& folder, std::string_view uri) {
  const auto relative = import::resolve_below("", uri);
  if (!relative) return std::nullopt;
  std::error_code fault;
  const fs::path top = fs::canonical(folder, fault);
  if (fault) return std::nullopt;
  const fs::path file = fs::canonical(top / *relative, fault);
  if (fault || !fs::is_regular_file(file, fault)) return std::nullopt;
  const bool is_inside = std::mismatch(top.begin(), top.end(), file.begin(), file.end()).first == top.end();
  return is_inside ? std::optional(file) : std::nullopt;
}

}  // namespace

import::ResourceReader folder_resources(const std::string& model_path){
    const fs::path parent = fs::path(model_path).parent_path();
return [folder = parent.empty() ? fs::path(".") : parent](std::string_view uri,
                                                          std::size_t max_bytes) -> Result<std::vector<std::uint8_t>> {
  auto file = file_inside(folder, uri);
  if (!file) file = file_inside(folder, uri.substr(uri.find_last_of("/\\") + 1));  // npos + 1 is 0
  if (!file) {
    return Error{ErrorCode::missing, "", "no file " + import::shown(uri) + " in the folder of the model file"};
  }
  try {
    return read_file(file->string(), max_bytes);
  } catch (const CommandFailure& failure) {
    return Error{ErrorCode::invalid_argument, "", failure.what()};
  }
};
}  // namespace semblante

}  // namespace semblante
