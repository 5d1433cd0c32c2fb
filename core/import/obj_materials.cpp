#include "core/import/obj_materials.h"

#include <algorithm>

#include "core/import/limits.h"
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

int ObjMaterials::image(std::string_view rest) {
  const std::string_view path = map_path(rest);
  if (path.empty()) return -1;
  if (const auto known = image_by_path_.find(path); known != image_by_path_.end()) return known->second;
  if (image_by_path_.size() == max_image_paths) return -1;
  int& index = image_by_path_[std::string(path)] = -1;
  auto bytes = load(path);
  if (!bytes) return -1;
  auto read = images_.read(std::move(*bytes));
  if (!read) {
    builder_.warn("the image " + shown(path) + " " + read.error().message + "; it is omitted");
    return -1;
  }
  builder_.model.images.push_back(std::move(*read));
  return index = static_cast<int>(builder_.model.images.size()) - 1;
}

void ObjMaterials::read_line(std::string_view keyword, std::string_view rest) {
  if (keyword == "newmtl") {
    current_ = by_name_.size() < max_materials ? &by_name_[std::string(trimmed(rest))] : nullptr;
    return;
  }
  if (current_ == nullptr) return;
  if (keyword == "Kd") {
    for (int i = 0; i < 3; ++i) current_->base_color[i] = unit(rest, current_->base_color[i]);
  } else if (keyword == "d") {
    current_->base_color.a = unit(rest, 1.0F);
  } else if (keyword == "Tr") {
    current_->base_color.a = 1.0F - unit(rest, 0.0F);
  } else if (keyword == "Pr") {
    current_->roughness = unit(rest, current_->roughness);
  } else if (keyword == "Pm") {
    current_->metallic = unit(rest, current_->metallic);
  } else if (keyword == "map_Kd") {
    current_->base_color_image = image(rest);
    current_->is_color_lost = current_->base_color_image < 0;
  } else if (keyword == "norm") {
    current_->normal_image = image(rest);
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

void ObjMaterials::fill(Material& material) const {
  const auto found = by_name_.find(material.name);
  if (found == by_name_.end()) return;
  const std::string name = material.name;
  material = found->second;
  material.name = name;
  // With a texture, Kd is ignored: exporters write a value that old viewers did not multiply with the texture.
  if (material.base_color_image >= 0) material.base_color = glm::vec4(1.0F, 1.0F, 1.0F, material.base_color.a);
  if (material.base_color.a < 1.0F) material.alpha_mode = Material::AlphaMode::blend;
}

}  // namespace semblante::import
