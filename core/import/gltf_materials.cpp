#include "core/import/gltf_materials.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "core/import/image_reader.h"
#include "core/import/image_size.h"
#include "core/import/limits.h"
#include "core/import/text.h"

namespace semblante::import {
namespace {

class MaterialReader {
 public:
  MaterialReader(GltfDocument& document, ModelBuilder& builder)
      : document_(document), builder_(builder), images_(builder.limits()) {}

  UvSource read(const JsonCursor& source) {
    Material material;
    UvSource uv;
    material.name = source.text_or("name", "");
    material.roughness = 1.0F;
    material.metallic = 1.0F;
    source.must_be_object();
    if (source.has("pbrMetallicRoughness")) {
      const JsonCursor pbr = source.member("pbrMetallicRoughness");
      material.base_color = color<4>(pbr, "baseColorFactor");
      material.metallic = unit(pbr, "metallicFactor");
      material.roughness = unit(pbr, "roughnessFactor");
      material.base_color_image = image_of(pbr, "baseColorTexture", &uv);
      material.is_color_lost = material.base_color_image < 0 && pbr.has("baseColorTexture");
    } else if (source.has("extensions") && source.member("extensions").has("KHR_materials_pbrSpecularGlossiness")) {
      const JsonCursor old = source.member("extensions").member("KHR_materials_pbrSpecularGlossiness");
      material.base_color = color<4>(old, "diffuseFactor");
      material.base_color_image = image_of(old, "diffuseTexture", &uv);
      material.is_color_lost = material.base_color_image < 0 && old.has("diffuseTexture");
      material.metallic = 0.0F;
      material.roughness = 1.0F - unit(old, "glossinessFactor");
    }
    if (source.has("extensions") && source.member("extensions").has("KHR_materials_unlit")) {
      material.metallic = 0.0F;
      material.roughness = 1.0F;
    }
    if (material.base_color_image < 0 && !material.is_color_lost) read_emission(source, material, uv);
    UvSource normal_uv;
    material.normal_image = image_of(source, "normalTexture", &normal_uv);
    if (material.base_color_image < 0) uv = normal_uv;
    if (material.normal_image >= 0 && (normal_uv.set != uv.set || normal_uv.transform != uv.transform)) {
      // Only the texture coordinates of the base colour are kept. With them the normal map would be misplaced.
      builder_.warn("the normal map of material " + shown(material.name) +
                    " has other texture coordinates than its base colour and is omitted");
      material.normal_image = -1;
    }
    const std::string mode = source.text_or("alphaMode", "OPAQUE");
    material.alpha_mode = mode == "MASK"    ? Material::AlphaMode::mask
                          : mode == "BLEND" ? Material::AlphaMode::blend
                                            : Material::AlphaMode::opaque;
    material.alpha_cutoff = static_cast<float>(std::clamp(source.number_or("alphaCutoff", 0.5), 0.0, 1.0));
    material.double_sided = source.boolean_or("doubleSided", false);
    // Exporters call materials blended that have no opacity at all.
    if (material.alpha_mode == Material::AlphaMode::blend && material.base_color.a >= 1.0F &&
        !has_alpha_image(material))
      material.alpha_mode = Material::AlphaMode::opaque;
    builder_.model.materials.push_back(std::move(material));
    return uv;
  }

 private:
  static float unit(const JsonCursor& object, const char* key) {
    return static_cast<float>(std::clamp(object.number_or(key, 1.0), 0.0, 1.0));
  }

  template <int size>
  static glm::vec<size, float> color(const JsonCursor& object, const char* key, float otherwise = 1.0F) {
    glm::vec<size, float> value(otherwise);
    if (!object.has(key)) return value;
    const JsonCursor array = object.member(key);
    if (array.size() != size) array.fail(ErrorCode::malformed, "must have " + std::to_string(size) + " numbers");
    for (std::size_t i = 0; i < std::min<std::size_t>(array.size(), size); ++i) {
      value[static_cast<int>(i)] = static_cast<float>(std::clamp(array.element(i).number(), 0.0, 1.0));
    }
    return value;
  }

  /// Scans without shading are written as a black surface that emits its picture.
  void read_emission(const JsonCursor& source, Material& material, UvSource& uv) {
    const bool is_black = glm::vec3(material.base_color) == glm::vec3(0.0F);
    if (!is_black || !source.has("emissiveTexture")) return;
    const glm::vec3 emitted = color<3>(source, "emissiveFactor", 0.0F);
    if (emitted == glm::vec3(0.0F)) return;
    material.base_color = glm::vec4(emitted, material.base_color.a);
    material.base_color_image = image_of(source, "emissiveTexture", &uv);
    material.is_color_lost = material.base_color_image < 0;
    material.metallic = 0.0F;
    material.roughness = 1.0F;
  }

  [[nodiscard]] bool has_alpha_image(const Material& material) const {
    return material.base_color_image >= 0 &&
           has_alpha(builder_.model.images[static_cast<std::size_t>(material.base_color_image)].bytes);
  }

  static void read_transform(const JsonCursor& transform, UvSource& uv) {
    const auto pair = [&transform](const char* key, double otherwise) {
      glm::dvec2 value(otherwise);
      if (transform.has(key)) {
        for (std::size_t i = 0; i < 2; ++i) value[static_cast<int>(i)] = transform.member(key).element(i).number();
      }
      return value;
    };
    const glm::dvec2 offset = pair("offset", 0.0);
    const glm::dvec2 scale = pair("scale", 1.0);
    const double angle = transform.number_or("rotation", 0.0);
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    // Columns of T * R * S, R as the extension defines it: counter-clockwise about the origin of the image.
    uv.transform = glm::dmat3(c * scale.x, -s * scale.x, 0.0, s * scale.y, c * scale.y, 0.0, offset.x, offset.y, 1.0);
    uv.is_identity = uv.transform == glm::dmat3(1.0);
    uv.set = static_cast<std::size_t>(transform.integer_or("texCoord", uv.set));
  }

  int image_of(const JsonCursor& object, const char* key, UvSource* uv) {
    if (!object.has(key)) return -1;
    const JsonCursor info = object.member(key);
    const std::size_t texture_index = info.required_index("index", document_.count("textures"));
    if (document_.failed()) return -1;
    if (uv != nullptr) {
      uv->set = static_cast<std::size_t>(info.integer_or("texCoord", 0));
      if (info.has("extensions") && info.member("extensions").has("KHR_texture_transform")) {
        read_transform(info.member("extensions").member("KHR_texture_transform"), *uv);
      }
    }
    const JsonCursor texture = document_.item("textures", texture_index);
    const auto source = source_of(texture);
    if (document_.failed()) return -1;
    if (!source) {
      builder_.warn("texture " + std::to_string(texture_index) + " has no image and is omitted");
      return -1;
    }
    const auto [entry, is_new] = image_by_source_.try_emplace(*source, -1);
    if (is_new) entry->second = load_image(*source);
    return entry->second;
  }

  /// The image of a texture: its own, which glTF's core can show, else that of an extension.
  std::optional<std::size_t> source_of(const JsonCursor& texture) {
    const std::size_t count = document_.count("images");
    const auto source = texture.index("source", count);
    if (source || document_.failed() || !texture.has("extensions")) return source;
    const JsonCursor extensions = texture.member("extensions");
    for (const char* const name : {"EXT_texture_webp", "KHR_texture_basisu"}) {
      if (!extensions.has(name)) continue;
      const auto of_extension = extensions.member(name).index("source", count);
      if (of_extension || document_.failed()) return of_extension;
    }
    return std::nullopt;
  }

  int load_image(std::size_t index) {
    const JsonCursor source = document_.item("images", index);
    std::vector<std::uint8_t> bytes;
    if (source.has("bufferView")) {
      const auto view_index = source.index("bufferView", document_.count("bufferViews"));
      if (!view_index) return -1;
      const auto view = document_.view(*view_index);
      if (within_limit(view.size(), source)) bytes.assign(view.begin(), view.end());
    } else {
      auto loaded = document_.resource(source.member("uri").text());
      if (document_.failed()) return -1;
      if (!loaded) {
        // A missing texture is not an error.
        builder_.warn("image " + std::to_string(index) + " " + loaded.error().message + "; it is omitted");
        return -1;
      }
      if (within_limit(loaded->size(), source)) bytes = std::move(*loaded);
    }
    if (document_.failed()) return -1;
    auto image = images_.read(std::move(bytes));
    if (!image) {
      builder_.warn("image " + std::to_string(index) + " " + image.error().message + "; it is omitted");
      return -1;
    }
    builder_.model.images.push_back(std::move(*image));
    return static_cast<int>(builder_.model.images.size()) - 1;
  }

  bool within_limit(std::size_t bytes, const JsonCursor& source) {
    const ImportLimits& limits = builder_.limits();
    image_bytes_ += bytes;
    if (bytes <= limits.max_image_bytes && image_bytes_ <= limits.max_file_bytes) return true;
    source.fail(ErrorCode::too_large, "has " + std::to_string(bytes) + " bytes, at most " +
                                          std::to_string(limits.max_image_bytes) + " are allowed");
    return false;
  }

  GltfDocument& document_;
  ModelBuilder& builder_;
  ImageReader images_;
  std::map<std::size_t, int> image_by_source_;
  std::size_t image_bytes_ = 0;
};

}  // namespace

std::vector<UvSource> read_materials(GltfDocument& document, ModelBuilder& builder) {
  const std::size_t count = document.count("materials");
  if (count > max_materials) {
    document.root()
        .member("materials")
        .fail(ErrorCode::too_large, "more than " + std::to_string(max_materials) + " materials");
    return {};
  }
  MaterialReader reader(document, builder);
  std::vector<UvSource> sources;
  for (std::size_t i = 0; i < count && !document.failed(); ++i) {
    sources.push_back(reader.read(document.item("materials", i)));
  }
  return sources;
}

}  // namespace semblante::import
