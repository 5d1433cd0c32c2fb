#include "core/import/relative_path.h"

#include <vector>

#include "core/types/percent_decode.h"

namespace semblante::import {
std::optional<std::string> resolve_below(std::string_view folder, std::string_view uri) {
  const auto decoded = percent_decode(uri);
  if (!decoded || decoded->empty() || decoded->front() == '/') return std::nullopt;
  if (decoded->find_first_of("\\:") != std::string::npos) return std::nullopt;
  std::vector<std::string_view> segments;
  const std::string path = std::string(folder) + *decoded;
  std::string_view rest = path;
  while (!rest.empty()) {
    const std::size_t slash = rest.find('/');
    const std::string_view segment = rest.substr(0, slash);
    rest = slash == std::string_view::npos ? std::string_view{} : rest.substr(slash + 1);
    if (segment == "..") {
      if (segments.empty()) return std::nullopt;
      segments.pop_back();
    } else if (!segment.empty() && segment != ".") {
      segments.push_back(segment);
    }
  }
  std::string name;
  for (const std::string_view segment : segments) {
    if (!name.empty()) name += '/';
    name += segment;
  }
  return name.empty() ? std::nullopt : std::optional(name);
}

}  // namespace semblante::import
