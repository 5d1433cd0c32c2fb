#pragma once

#include <filesystem>
#include <string>

#include "server/http/message.h"

namespace semblante::http {

/// A file below `root` for a decoded request path; "/" is index.html. Paths outside the root (dot segments, links) and
/// paths that are not regular files get 404. Files whose name has a content hash (assets/name-<8+ characters>.ext, as
/// Vite writes them) may be cached for a year, all others are revalidated by their ETag. "/view/<stream>" is
/// view/index.html, and a folder with an index.html is redirected to its address with a slash. A file that has name.br
/// or name.gz beside it, not older than itself, is sent in that form to those who accept it.
Response static_file(const std::filesystem::path& root, const Request& request);

/// Whether it has an answer other than 404 for this path.
[[nodiscard]] bool has_static_file(const std::filesystem::path& root, const std::string& path);

/// Whether a file or folder, which need not exist yet, lies below `root` or is it, wherever links lead.
[[nodiscard]] bool lies_within(const std::filesystem::path& root, const std::filesystem::path& file);

}  // namespace semblante::http
