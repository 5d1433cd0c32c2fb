#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace semblante {

enum class ModelFormat { glb, gltf, gltf_zip, obj, ply, stl };

inline constexpr std::string_view glb_media_type = "model/gltf-binary";

/// A kind of model file.
struct ModelFile {
  std::string_view ending;  ///< of its name, in small letters
  ModelFormat format;
  std::string_view media_type;
  std::string_view title;  ///< for display
};

/// The only table of model files. Tests compare the studio's (web/src/net/model_formats.ts), openapi.json and user
/// texts with it.
inline constexpr auto model_files = std::to_array<ModelFile>({
    {".glb", ModelFormat::glb, glb_media_type, "GLB"},
    {".vrm", ModelFormat::glb, glb_media_type, "VRM"},
    {".gltf", ModelFormat::gltf, "model/gltf+json", "glTF"},
    {".obj", ModelFormat::obj, "model/obj", "OBJ"},
    {".ply", ModelFormat::ply, "model/ply", "PLY"},
    {".stl", ModelFormat::stl, "model/stl", "STL"},
    {".zip", ModelFormat::gltf_zip, "application/zip", "ZIP"},
});

/// Other accepted media types of these files; the format is detected from the bytes.
inline constexpr auto other_model_media_types =
    std::to_array<std::string_view>({"application/octet-stream", "application/ply", "application/sla",
                                     "application/x-zip-compressed", "model/vnd.ply", "text/plain"});

/// A format as options and reports name it.
struct ModelFormatName {
  ModelFormat format;
  std::string_view name;
};

/// Every format once.
inline constexpr auto model_formats = std::to_array<ModelFormatName>({{ModelFormat::glb, "glb"},
                                                                      {ModelFormat::gltf, "gltf"},
                                                                      {ModelFormat::gltf_zip, "gltf_zip"},
                                                                      {ModelFormat::obj, "obj"},
                                                                      {ModelFormat::ply, "ply"},
                                                                      {ModelFormat::stl, "stl"}});

/// Its name in the table.
std::string_view to_string(ModelFormat format);

/// The reverse; nullopt for any other text.
std::optional<ModelFormat> parse_model_format(std::string_view name);

/// By the ending of a file's name, in any case; nullopt for endings that are not in the table.
std::optional<ModelFormat> format_of_name(std::string_view file_name);

/// "GLB, VRM, glTF" and so on.
std::string model_file_titles();

}  // namespace semblante
