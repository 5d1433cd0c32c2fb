#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/import/image_reader.h"
#include "core/import/model_builder.h"
#include "core/import/resource_reader.h"

namespace semblante::import {

/// The material files of an OBJ, which define the materials named by `usemtl`. Reads colours, opacity, roughness and
/// the images of base colour and normals. Unsupported or missing content becomes a warning instead of an error, because
/// a head is usable without its texture.
class ObjMaterials {
 public:
  ObjMaterials(ModelBuilder& builder, ResourceReader resources)
      : builder_(builder), resources_(std::move(resources)), images_(builder.limits()) {}

  /// Reads one file of an `mtllib` line.
  void read_library(std::string_view name);
  /// Sets the properties of a material after all files are read; does nothing for a material that no file defines.
  void fill(Material& material);

 private:
  /// A material of a file, with the paths of its images of colour and of opacity.
  struct Described {
    Material material;
    std::string color_path, opacity_path;
  };

  void read_line(std::string_view keyword, std::string_view rest);
  int image(std::string_view rest);
  std::optional<std::vector<std::uint8_t>> load(std::string_view name);

  ModelBuilder& builder_;
  ResourceReader resources_;
  ImageReader images_;
  std::map<std::string, Described, std::less<>> by_name_;
  std::map<std::string, int, std::less<>> image_by_path_;
  std::size_t bytes_read_ = 0;
  Described* current_ = nullptr;
};

}  // namespace semblante::import
