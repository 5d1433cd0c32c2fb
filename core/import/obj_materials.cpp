#include "core/import/obj_materials.h"

#include <algorithm>

#include "core/import/image_size.h"
#include "core/import/limits.h"
#include "core/import/opacity_image.h"
#include "core/import/text.h"

namespace semblante::import {
namespace {

/// Maximum number of image paths looked up: each is compared with every entry of the zip.
constexpr std::size_t max_image_paths = 1024;
constexpr std::size_t max_library_bytes = std::size_t{4} << 20;

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t");
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t\r") - begin + 1);
}

/// One number in 0..1; `otherwise` for anything else.
float unit(std::string_view& rest, float otherwise) {
  float value = 0.0F;
  if (parse_number(next_token(rest), value) != NumberFault::none) return otherwise;
  return std::clamp(value, 0.0F, 1.0F);
}

/// The file name after the options of a map ("-s 1 1 1 -bm 0.5 skin colour.png"): option values are numbers, on or off,
/// or a channel; the name is the rest of the line.
std::string_view map_path(std::string_view rest) {
  rest = trimmed(rest);
  while (rest.starts_with('-')) {
    next_token(rest);
    rest = trimmed(rest);
    for (int arguments = 0; arguments < 3; ++arguments) {
      std::string_view after = rest;
      const std::string_view token = next_token(after);
      float number = 0.0F;
      const bool is_argument =
          parse_number(token, number) == NumberFault::none || token == "on" || token == "off" ||
          (token.size() == 1 && std::string_view("rgbmlz").find(token[0]) != std::string_view::npos);
      if (!is_argument) break;
      rest = trimmed(after);
    }
  }
  return rest;
}

}  // namespace

std::optional<std::vector<std::uint8_t>> ObjMaterials::load(std::string_view name) {
  const std::size_t limit = builder_.limits().max_file_bytes;
  auto bytes = resources_(name, limit - std::min(bytes_read_, limit));
  if (!bytes) {
    builder_.warn(shown(name) + ", to which the OBJ file refers, is omitted: " + bytes.error().message);
    return std::nullopt;
  }
  bytes_read_ += bytes->size();
  return std::move(*bytes);
}

void ObjMaterials::omit_image(std::string_view path, const Error& fault) {
  builder_.warn("the image " + shown(path) + " " + fault.message + "; it is omitted");
}

const Image* ObjMaterials::load_image(const std::string& path) {
  if (path.empty()) return nullptr;
  const auto known = images_by_path_.find(path);
  if (known == images_by_path_.end()) {
    if (images_by_path_.size() == max_image_paths) return nullptr;
    LoadedImage& loaded = images_by_path_[path];
    auto bytes = load(path);
    if (!bytes) return nullptr;
    auto read = images_.read(std::move(*bytes));
    if (!read) {
      omit_image(path, read.error());
      return nullptr;
    }
    return &loaded.image.emplace(std::move(*read));
  }
  const LoadedImage& loaded = known->second;
  if (loaded.index >= 0) return &builder_.model.images[static_cast<std::size_t>(loaded.index)];
  return loaded.image ? &*loaded.image : nullptr;
}

int ObjMaterials::use_image(const std::string& path) {
  if (load_image(path) == nullptr) return -1;
  LoadedImage& loaded = images_by_path_[path];
  if (loaded.index < 0) {
    builder_.model.images.push_back(std::move(*loaded.image));
    loaded.image.reset();
    loaded.index = static_cast<int>(builder_.model.images.size()) - 1;
  }
  return loaded.index;
}

std::optional<Pixels> ObjMaterials::decode(const std::string& path) {
  const Image* const image = load_image(path);
  if (image == nullptr) return std::nullopt;
  auto pixels = images_.decode(*image);
  if (pixels) return std::move(*pixels);
  omit_image(path, pixels.error());
  return std::nullopt;
}

ObjMaterials::ColorImage ObjMaterials::make_color_image(const std::string& color_path,
                                                        const std::string& opacity_path) {
  const auto opacity = decode(opacity_path);
  if (!opacity) return {};
  const auto color = decode(color_path);
  if (!color && load_image(color_path) != nullptr) return {};
  auto made = with_opacity(color ? &*color : nullptr, *opacity);
  if (!made) return {};
  builder_.model.images.push_back(std::move(made->image));
  return {static_cast<int>(builder_.model.images.size()) - 1, made->mode};
}

void ObjMaterials::read_line(std::string_view keyword, std::string_view rest) {
  if (keyword == "newmtl") {
    current_ = by_name_.size() < max_materials ? &by_name_[std::string(trimmed(rest))] : nullptr;
    return;
  }
  if (current_ == nullptr) return;
  Material& material = current_->material;
  if (keyword == "Kd") {
    for (int i = 0; i < 3; ++i) material.base_color[i] = unit(rest, material.base_color[i]);
  } else if (keyword == "d") {
    material.base_color.a = unit(rest, 1.0F);
  } else if (keyword == "Tr") {
    material.base_color.a = 1.0F - unit(rest, 0.0F);
  } else if (keyword == "Pr") {
    material.roughness = unit(rest, material.roughness);
  } else if (keyword == "Pm") {
    material.metallic = unit(rest, material.metallic);
  } else if (keyword == "map_Kd") {
    current_->color_path = map_path(rest);
  } else if (keyword == "map_d") {
    current_->opacity_path = map_path(rest);
  } else if (keyword == "norm") {
    current_->normal_path = map_path(rest);
  }
}

void ObjMaterials::read_library(std::string_view name) {
  const auto bytes = load(trimmed(name));
  if (!bytes) return;
  if (bytes->size() > max_library_bytes) {
    builder_.warn("the material file " + shown(name) + " is too large and is omitted");
    return;
  }
  current_ = nullptr;
  LineReader lines(as_text(*bytes));
  while (const auto line = lines.next()) {
    std::string_view rest = *line;
    const std::string_view keyword = next_token(rest);
    read_line(keyword, rest);
  }
}

void ObjMaterials::fill(Material& material) {
  const auto found = by_name_.find(material.name);
  if (found == by_name_.end()) return;
  const auto& [described, color_path, normal_path, opacity_path] = found->second;
  const std::string name = material.name;
  material = described;
  material.name = name;
  ColorImage image;
  if (!opacity_path.empty() && opacity_path != color_path) {
    const auto [made, is_new] = color_images_.try_emplace({color_path, opacity_path});
    if (is_new) made->second = make_color_image(color_path, opacity_path);
    image = made->second;
    // Some exporters write an opacity of 0 beside the image.
    if (image.index >= 0 && material.base_color.a == 0.0F) material.base_color.a = 1.0F;
  }
  material.alpha_mode = material.base_color.a < 1.0F ? Material::AlphaMode::blend : image.mode;
  material.base_color_image = image.index >= 0 ? image.index : use_image(color_path);
  material.normal_image = use_image(normal_path);
  const Image* const color = load_image(color_path);
  material.is_color_lost = color == nullptr && !color_path.empty();
  if (color == nullptr) return;
  // With a texture, Kd is ignored: exporters write a value that old viewers did not multiply with the texture.
  material.base_color = glm::vec4(1.0F, 1.0F, 1.0F, material.base_color.a);
  // Hair and lashes are cards: their image of colour has the opacity, and is named a second time. So is that of skin,
  // by some exporters, so the material is a mask: what is blended casts no shadow.
  const bool is_named_twice = opacity_path == color_path && has_alpha(color->bytes);
  if (is_named_twice && material.alpha_mode == Material::AlphaMode::opaque) {
    material.alpha_mode = Material::AlphaMode::mask;
  }
}

}  // namespace semblante::import
