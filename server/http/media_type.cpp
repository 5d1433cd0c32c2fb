#include "server/http/media_type.h"

#include <array>
#include <utility>

#include "core/types/letter_case.h"
#include "core/types/percent_decode.h"
#include "server/http/message.h"

namespace semblante::http {
namespace {

std::string_view trim(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  return text;
}

}  // namespace

std::vector<std::string> split_list(std::string_view value, char separator) {
  std::vector<std::string> items;
  while (true) {
    const auto end = value.find(separator);
    const auto item = trim(value.substr(0, end));
    if (!item.empty()) items.emplace_back(item);
    if (end == std::string_view::npos) return items;
    value.remove_prefix(end + 1);
  }
}

std::string essence(std::string_view media_type) {
  return lower_case(trim(media_type.substr(0, media_type.find(';'))));
}

std::string parameter(std::string_view value, std::string_view name) {
  // Scans instead of splitting: a quoted value may contain semicolons.
  std::size_t at = value.find(';');
  while (at != std::string_view::npos) {
    ++at;
    const auto equals = value.find('=', at);
    if (equals == std::string_view::npos) return {};
    const auto key = trim(value.substr(at, equals - at));
    std::size_t from = equals + 1;
    while (from < value.size() && value[from] == ' ') ++from;
    std::string found;
    if (from < value.size() && value[from] == '"') {
      for (++from; from < value.size() && value[from] != '"'; ++from) {
        if (value[from] == '\\' && from + 1 < value.size()) ++from;
        found.push_back(value[from]);
      }
      at = value.find(';', from);
    } else {
      at = value.find(';', from);
      found = trim(value.substr(from, at == std::string_view::npos ? at : at - from));
    }
    if (equal_ignoring_case(key, name)) return found;
  }
  return {};
}

std::string file_name_of(std::string_view disposition) {
  const std::string extended = parameter(disposition, "filename*");
  const auto charset_end = extended.find('\'');
  const auto language_end = charset_end == std::string::npos ? charset_end : extended.find('\'', charset_end + 1);
  if (language_end != std::string::npos && equal_ignoring_case(extended.substr(0, charset_end), "utf-8")) {
    if (auto name = percent_decode(std::string_view(extended).substr(language_end + 1))) return *std::move(name);
  }
  return parameter(disposition, "filename");
}

bool accepts(std::string_view accept, std::string_view media_type) {
  if (trim(accept).empty()) return true;
  const auto wanted = essence(media_type);
  const auto group = wanted.substr(0, wanted.find('/')) + "/*";
  // The most specific range that matches decides, so that "*/*, x/y;q=0" excludes x/y.
  int best = -1;
  bool taken = false;
  for (const auto& range : split_list(accept)) {
    const auto name = essence(range);
    const int rank = name == wanted ? 2 : name == group ? 1 : name == "*/*" ? 0 : -1;
    if (rank <= best) continue;
    best = rank;
    const auto weight = parameter(range, "q");
    taken = weight.empty() || weight.find_first_of("123456789") != std::string::npos;
  }
  return taken;
}

std::string_view media_type_of_file(std::string_view file_name) {
  static constexpr auto table = std::to_array<std::pair<std::string_view, std::string_view>>({
      {".html", "text/html; charset=utf-8"},
      {".js", "text/javascript; charset=utf-8"},
      {".mjs", "text/javascript; charset=utf-8"},
      {".css", "text/css; charset=utf-8"},
      {".json", "application/json"},
      {".map", "application/json"},
      {".webmanifest", "application/manifest+json"},
      {".wasm", "application/wasm"},
      {".svg", "image/svg+xml"},
      {".png", "image/png"},
      {".jpg", "image/jpeg"},
      {".jpeg", "image/jpeg"},
      {".webp", "image/webp"},
      {".ico", "image/x-icon"},
      {".woff2", "font/woff2"},
      {".woff", "font/woff"},
      {".txt", "text/plain; charset=utf-8"},
      {".md", "text/markdown; charset=utf-8"},
      {".glb", "model/gltf-binary"},
      {".gltf", "model/gltf+json"},
      {".drc", "application/octet-stream"},
  });
  const auto dot = file_name.rfind('.');
  if (dot != std::string_view::npos)
    for (const auto& [extension, type] : table)
      if (equal_ignoring_case(file_name.substr(dot), extension)) return type;
  return "application/octet-stream";
}

}  // namespace semblante::http
