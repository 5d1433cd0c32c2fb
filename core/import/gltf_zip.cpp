#include "core/import/gltf_zip.h"

#include <algorithm>

#include "core/import/foreign_file.h"
#include "core/import/gltf_reader.h"
#include "core/import/model_formats.h"
#include "core/import/obj_reader.h"
#include "core/import/ply_reader.h"
#include "core/import/relative_path.h"
#include "core/import/stl_reader.h"
#include "core/import/text.h"
#include "core/import/zip_archive.h"
#include "core/types/letter_case.h"
#include "core/types/percent_decode.h"

namespace semblante::import {
namespace {

bool has_ending(std::string_view name, std::string_view ending) { return lower_case(name).ends_with(ending); }

/// The only entry with this ending; nullopt when there is none.
Result<std::optional<std::string>> only_entry(const std::vector<std::string>& names, std::string_view ending) {
  std::optional<std::string> found;
  for (const std::string& name : names) {
    if (!has_ending(name, ending)) continue;
    if (found) {
      return Error{ErrorCode::invalid_argument, "", "the zip has two models, " + shown(*found) + " and " + shown(name),
                   Advice::send_one_model};
    }
    found = name;
  }
  return found;
}

/// The only entry with this file name, in any folder and in capitals or not.
std::optional<std::string> only_entry_called(const std::vector<std::string>& names, std::string_view file_name) {
  const std::string name = lower_case(file_name);
  if (name.empty()) return std::nullopt;
  std::optional<std::string> found;
  for (const std::string& entry : names) {
    const std::string_view last = std::string_view(entry).substr(entry.rfind('/') + 1);
    if (last.size() != name.size() || lower_case(last) != name) continue;
    if (found) return std::nullopt;
    found = entry;
  }
  return found;
}

/// The entry for a path in a file that is in `folder`. Models have paths of another machine, or names in other capitals
/// than on a disk that does not tell them apart: if the path does not exist, the only entry with its file name is used.
std::optional<std::string> find_entry(const std::vector<std::string>& names, const std::string& folder,
                                      std::string_view path) {
  auto resolved = resolve_below(folder, path);
  if (resolved && std::find(names.begin(), names.end(), *resolved) != names.end()) return resolved;
  const std::string_view file_name = path.substr(path.find_last_of("/\\") + 1);  // npos + 1 is 0
  if (auto found = only_entry_called(names, file_name)) return found;
  const auto decoded = percent_decode(file_name);
  return decoded && *decoded != file_name ? only_entry_called(names, *decoded) : std::nullopt;
}

/// What macOS keeps beside a file: "__MACOSX/a/._head.obj" in its own zips, "a/._head.obj" on a disk of another system.
bool is_resource_fork(std::string_view name) {
  return name.starts_with("__MACOSX/") || name.substr(name.rfind('/') + 1).starts_with("._");  // npos + 1 is 0
}

std::string folder_of(const std::string& name) {
  return name.substr(0, name.rfind('/') == std::string::npos ? 0 : name.rfind('/') + 1);
}

}  // namespace

Result<Model> read_gltf_zip(std::span<const std::uint8_t> bytes, const ImportLimits& limits) {
  auto archive = ZipArchive::open(bytes, limits.max_file_bytes);
  if (!archive) return archive.error();
  std::vector<std::string> names = archive->names();
  std::erase_if(names, is_resource_fork);
  std::optional<std::string> name;
  for (const std::string_view ending : {".gltf", ".glb", ".vrm", ".obj", ".ply", ".stl"}) {
    const auto entry = only_entry(names, ending);
    if (!entry) return entry.error();
    if (!*entry) continue;
    name = **entry;
    break;
  }
  if (!name) {
    if (const auto other = foreign_zip(names)) return Error{ErrorCode::missing, "", other->sentence, other->advice};
    return Error{ErrorCode::missing, "", "the zip has no .gltf, .glb, .vrm, .obj, .ply or .stl file",
                 Advice::export_as_glb};
  }
  const auto model = archive->read(*name, limits.max_file_bytes);
  if (!model) return model.error();
  const std::string folder = folder_of(*name);
  const auto format = format_of_name(*name);
  if (format == ModelFormat::ply) return read_ply(*model, limits);
  if (format == ModelFormat::stl) return read_stl(*model, limits);
  if (format == ModelFormat::obj) {
    return read_obj(*model, limits,
                    [&](std::string_view path, std::size_t max_bytes) -> Result<std::vector<std::uint8_t>> {
                      const auto entry = find_entry(names, folder, path);
                      if (!entry) return Error{ErrorCode::missing, "", "the zip has no such file"};
                      return archive->read(*entry, max_bytes);
                    });
  }
  const auto resources = [&](std::string_view uri, std::size_t max_bytes) -> Result<std::vector<std::uint8_t>> {
    if (const auto entry = find_entry(names, folder, uri)) return archive->read(*entry, max_bytes);
    const auto missing = resolve_below(folder, uri);
    if (!missing) {
      return Error{ErrorCode::unsupported, "", "refers to " + shown(uri) + ", which is outside of the zip",
                   Advice::send_all_files};
    }
    return archive->read(*missing, max_bytes);  // says that it is missing
  };
  return format == ModelFormat::gltf ? read_gltf(as_text(*model), limits, resources)
                                     : read_glb(*model, limits, resources);
}

}  // namespace semblante::import
