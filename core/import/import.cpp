#include "core/import/import.h"

#include <algorithm>
#include <new>
#include <string>

#include "core/import/foreign_file.h"
#include "core/import/gltf_reader.h"
#include "core/import/gltf_zip.h"
#include "core/import/obj_reader.h"
#include "core/import/ply_reader.h"
#include "core/import/stl_reader.h"
#include "core/import/text.h"
#include "core/types/letter_case.h"

namespace semblante {
namespace {

using import::as_text;

/// A binary STL has no magic number: 80 arbitrary bytes, a count, and 50 bytes per triangle.
bool has_size_of_binary_stl(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < 84) return false;
  const std::uint64_t count = static_cast<std::uint64_t>(bytes[80]) | static_cast<std::uint64_t>(bytes[81]) << 8 |
                              static_cast<std::uint64_t>(bytes[82]) << 16 | static_cast<std::uint64_t>(bytes[83]) << 24;
  return bytes.size() == 84 + 50 * count;
}

/// Whether one of the first lines is a `v`, `f` or another line specific to OBJ.
bool looks_like_obj(std::string_view text) {
  constexpr int lines_to_try = 200;
  import::LineReader lines(text.substr(0, 65536));
  for (int i = 0; i < lines_to_try; ++i) {
    auto line = lines.next();
    if (!line) return false;
    const std::string_view keyword = import::next_token(*line);
    if (keyword == "v" || keyword == "vt" || keyword == "vn" || keyword == "f" || keyword == "mtllib" ||
        keyword == "usemtl") {
      return true;
    }
  }
  return false;
}

}  // namespace

std::optional<ModelFormat> detect_format(std::span<const std::uint8_t> bytes, std::string_view file_name) {
  std::string_view text = as_text(bytes);
  if (text.starts_with("glTF")) return ModelFormat::glb;
  if (text.starts_with("PK\x03\x04")) return ModelFormat::gltf_zip;
  if (text.starts_with("ply\n") || text.starts_with("ply\r")) return ModelFormat::ply;
  if (has_size_of_binary_stl(bytes)) return ModelFormat::stl;
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  const std::size_t begin = std::min(text.find_first_not_of(" \t\r\n"), text.size());
  if (text.substr(begin).starts_with('{')) return ModelFormat::gltf;
  const std::string head = lower_case(text.substr(begin, 4096));
  if (head.starts_with("solid") && head.find("facet") != std::string::npos) return ModelFormat::stl;
  if (import::foreign_file(bytes)) return std::nullopt;  // a web page may be called head.glb
  if (const auto named = format_of_name(file_name)) return named;
  if (looks_like_obj(text)) return ModelFormat::obj;
  return std::nullopt;
}

Result<ModelFormat> format_of(std::span<const std::uint8_t> bytes, std::string_view file_name) {
  if (const auto format = detect_format(bytes, file_name)) return *format;
  if (const auto foreign = import::foreign_file(bytes))
    return Error{ErrorCode::unsupported, "", foreign->sentence, foreign->advice};
  return Error{ErrorCode::unsupported, "", "the file is none of " + model_file_titles(), Advice::export_as_glb};
}

Result<Model> import_model(std::span<const std::uint8_t> bytes, ModelFormat format, const ImportLimits& limits,
                           const import::ResourceReader& resources) {
  if (bytes.size() > limits.max_file_bytes) {
    return Error{ErrorCode::too_large, "",
                 "the file has " + std::to_string(bytes.size()) + " bytes, at most " +
                     std::to_string(limits.max_file_bytes) + " are allowed",
                 Advice::reduce_model};
  }
  if (bytes.empty()) return Error{ErrorCode::empty, "", "the file is empty"};
  try {
    switch (format) {
      case ModelFormat::glb:
        return import::read_glb(bytes, limits, resources);
      case ModelFormat::gltf:
        return import::read_gltf(as_text(bytes), limits, resources);
      case ModelFormat::gltf_zip:
        return import::read_gltf_zip(bytes, limits);
      case ModelFormat::obj:
        return import::read_obj(bytes, limits, resources);
      case ModelFormat::ply:
        return import::read_ply(bytes, limits);
      case ModelFormat::stl:
        return import::read_stl(bytes, limits);
    }
    return Error{ErrorCode::invalid_argument, "", "unknown model format"};
  } catch (const std::bad_alloc&) {
    // Within the limits, but more memory than this machine has: an error of the file must not end the server.
    return Error{ErrorCode::too_large, "", "the model needs more memory than is available", Advice::reduce_model};
  }
}

}  // namespace semblante
