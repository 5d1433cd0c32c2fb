#include "core/import/gltf_zip.h"

#include <algorithm>

#include "core/import/gltf_reader.h"
#include "core/import/text.h"
#include "core/import/zip_archive.h"

namespace semblante::import {
namespace {

bool has_ending(std::string name, std::string_view ending) {
  std::transform(name.begin(), name.end(), name.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return name.ends_with(ending);
}

/// The one entry with this ending; nullopt when there is none. Resource forks that macOS adds do not count.
Result<std::optional<std::string>> only_entry(const std::vector<std::string>& names, std::string_view ending) {
  std::optional<std::string> found;
  for (const std::string& name : names) {
    if (!has_ending(name, ending) || name.starts_with("__MACOSX/")) continue;
    if (found) {
      return Error{ErrorCode::invalid_argument, "", "the zip has two models, " + shown(*found) + " and " + shown(name)};
    }
    found = name;
  }
  return found;
}

}  // namespace

Result<Model> read_gltf_zip(std::span<const std::uint8_t> bytes, const ImportLimits& limits) {
  const auto archive = ZipArchive::open(bytes);
  if (!archive) return archive.error();
  const std::vector<std::string> names = archive->names();
  const auto gltf = only_entry(names, ".gltf");
  if (!gltf) return gltf.error();
  const auto glb = only_entry(names, ".glb");
  if (!glb) return glb.error();
  if (!*gltf && !*glb) return Error{ErrorCode::missing, "", "the zip has no .gltf or .glb"};
  const std::string& name = *gltf ? **gltf : **glb;
  const auto model = archive->read(name, limits.max_file_bytes);
  if (!model) return model.error();
  if (!*gltf) return read_glb(*model, limits);

  const std::string folder = name.substr(0, name.rfind('/') == std::string::npos ? 0 : name.rfind('/') + 1);
  std::size_t left = limits.max_file_bytes - model->size();
  const ResourceReader resources = [&](std::string_view uri,
                                       std::size_t max_bytes) -> Result<std::vector<std::uint8_t>> {
    const auto entry = resolve_in_zip(folder, uri);
    if (!entry) return Error{ErrorCode::unsupported, "", "refers to " + shown(uri) + " outside of the zip"};
    auto resource = archive->read(*entry, std::min(max_bytes, left));
    if (resource) left -= resource->size();
    return resource;
  };
  return read_gltf(as_text(*model), resources, limits);
}

}  // namespace semblante::import
