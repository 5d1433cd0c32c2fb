#include "server/http/static_files.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <system_error>

#include <sys/stat.h>

#include "server/http/conditional.h"
#include "server/http/content_coding.h"
#include "server/http/media_type.h"
#include "server/http/problem.h"
#include "server/http/security_headers.h"

namespace semblante::http {
namespace {

/// "assets/index-BTK3ftMc.js": a bundler's name that contains a hash of the content.
bool has_hashed_name(const std::string& path) {
  if (path.find("/assets/") == std::string::npos) return false;
  const auto name = path.substr(path.rfind('/') + 1);
  const auto dash = name.rfind('-');
  if (dash == std::string::npos) return false;
  const auto dot = name.find('.', dash);
  return dot != std::string::npos && dot - dash - 1 >= 8;
}

/// "/view/demo": the page that shows a stream is one file, whatever the stream. A name with a dot is a file of its own.
bool shows_stream(const std::string& path) {
  constexpr std::string_view folder = "/view/";
  return path.substr(0, folder.size()) == folder && path.find_first_of("./", folder.size()) == std::string::npos;
}

std::optional<struct stat> regular_file(const std::filesystem::path& file) {
  struct stat info {};
  if (::stat(file.c_str(), &info) != 0 || !S_ISREG(info.st_mode)) return std::nullopt;
  return info;
}

struct Coding {
  std::string_view name, extension;
};

/// Compressed forms that the build lays beside a file, the smallest first.
constexpr std::array<Coding, 2> codings = {{{"br", ".br"}, {"gzip", ".gz"}}};

bool is_older(const struct stat& a, const struct stat& b) {
  return a.st_mtim.tv_sec < b.st_mtim.tv_sec ||
         (a.st_mtim.tv_sec == b.st_mtim.tv_sec && a.st_mtim.tv_nsec < b.st_mtim.tv_nsec);
}

/// "/view" to "/view/": addresses in a page are relative to its folder. So is this one, for a proxy's path before it.
Response moved_into_folder(const std::string& path) {
  Response response;
  response.status = 308;
  response.headers["Location"] = path.substr(path.rfind('/') + 1) + "/";
  response.headers["Cache-Control"] = "no-cache";
  return response;
}

/// What is served at a path: a file, or a folder whose page has an address of its own.
struct Found {
  std::filesystem::path file;
  std::optional<struct stat> info;  ///< of the file; nullopt: it is a folder with a page
};

std::optional<Found> find_file(const std::filesystem::path& root, const std::string& path) {
  if (path.find("/.") != std::string::npos || path.find('\\') != std::string::npos) return std::nullopt;
  std::error_code error;
  const auto file = std::filesystem::canonical(root / path.substr(1), error);
  if (error || !lies_within(root, file)) return std::nullopt;
  auto info = regular_file(file);
  if (!info && !regular_file(file / "index.html")) return std::nullopt;
  return Found{file, info};
}

/// The path of the file that is served at an address.
std::string file_path(const std::string& address) {
  std::string path = shows_stream(address) ? "/view/" : address;
  if (path.back() == '/') path += "index.html";
  return path;
}

}  // namespace

bool lies_within(const std::filesystem::path& root, const std::filesystem::path& file) {
  std::error_code error;
  const auto base = std::filesystem::canonical(root, error);
  if (error) return false;
  // Of a relative path without any existing part, `weakly_canonical` alone makes no absolute one.
  const auto place = std::filesystem::weakly_canonical(std::filesystem::absolute(file), error);
  if (error) return false;
  return std::mismatch(base.begin(), base.end(), place.begin(), place.end()).first == base.end();
}

Response static_file(const std::filesystem::path& root, const Request& request) {
  const auto path = file_path(request.path);
  const auto found = find_file(root, path);
  if (!found) return to_response(make_problem("not-found", "nothing is served at " + request.path));
  if (!found->info) return moved_into_folder(path);

  Response response;
  const auto& file = found->file;
  auto sent = file;
  auto info = found->info;
  std::string_view coding;
  for (const auto& [name, extension] : codings) {
    const auto packed = std::filesystem::path(file) += extension;
    const auto packed_info = regular_file(packed);
    // A file that was replaced has left its compressed forms behind.
    if (!packed_info || is_older(*packed_info, *info)) continue;
    vary_by(response, "Accept-Encoding");
    if (!coding.empty() || !wants_coding(request, name)) continue;
    coding = name;
    sent = packed;
    info = packed_info;
  }
  response.headers["Content-Type"] = std::string(media_type_of_file(file.filename().string()));
  response.headers["Cache-Control"] = has_hashed_name(path) ? std::string(cache_forever) : "no-cache";
  response.headers["ETag"] = "\"" + std::to_string(info->st_size) + "-" + std::to_string(info->st_mtim.tv_sec) + "." +
                             std::to_string(info->st_mtim.tv_nsec) + "\"";
  for (const auto& [name, value] : page_headers()) response.headers[name] = value;
  if (!coding.empty()) mark_coding(response, coding);
  response.body = FileBody{sent, 0, static_cast<std::uint64_t>(info->st_size)};
  return apply_conditions(request, std::move(response));
}

bool has_static_file(const std::filesystem::path& root, const std::string& path) {
  return find_file(root, file_path(path)).has_value();
}

}  // namespace semblante::http
