#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
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
  /// A material of a file, with the paths of its images.
  struct Described {
    Material material;
    std::string color_path, normal_path, opacity_path;
  };
  struct LoadedImage {
    std::optional<Image> image;  ///< until it is one of the model's
    int index = -1;              ///< in the model
  };
  /// With opacity.
  struct ColorImage {
    int index = -1;  ///< in the model
    Material::AlphaMode mode = Material::AlphaMode::opaque;
  };

  void read_line(std::string_view keyword, std::string_view rest);
  void omit_image(std::string_view path, const Error& fault);
  /// Null, with a warning, if there is no such image.
  const Image* load_image(const std::string& path);
  /// The image's number in the model, which has it from then on; -1 if there is no such image.
  int use_image(const std::string& path);
  std::optional<Pixels> decode(const std::string& path);
  /// The colours of one image with the opacity of another; without an index if there is no such opacity.
  ColorImage make_color_image(const std::string& color_path, const std::string& opacity_path);
  std::optional<std::vector<std::uint8_t>> load(std::string_view name);

  ModelBuilder& builder_;
  ResourceReader resources_;
  ImageReader images_;
  std::map<std::string, Described, std::less<>> by_name_;
  std::map<std::string, LoadedImage> images_by_path_;
  std::map<std::pair<std::string, std::string>, ColorImage> color_images_;  ///< by the paths of colour and opacity
  std::size_t bytes_read_ = 0;
  Described* current_ = nullptr;
};

}  // namespace semblante::import
