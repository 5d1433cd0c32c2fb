#include "protocol/cpp/rig_material.h"

#include <algorithm>
#include <optional>

namespace semblante {
namespace {

Material::AlphaMode alpha_mode_of(RigDocument::MaterialInfo::AlphaMode mode) {
  switch (mode) {
    case RigDocument::MaterialInfo::AlphaMode::opaque:
      return Material::AlphaMode::opaque;
    case RigDocument::MaterialInfo::AlphaMode::mask:
      return Material::AlphaMode::mask;
    case RigDocument::MaterialInfo::AlphaMode::blend:
      return Material::AlphaMode::blend;
  }
  return Material::AlphaMode::opaque;
}

int index_of(const std::optional<Sha256>& hash, const std::vector<RigDocument::ImageInfo>& images) {
  if (!hash) return -1;
  const auto at = std::find_if(images.begin(), images.end(), [&](const auto& image) { return image.sha256 == *hash; });
  return at == images.end() ? -1 : static_cast<int>(at - images.begin());
}

}  // namespace

Material material_of(const RigDocument::MaterialInfo& info, const std::vector<RigDocument::ImageInfo>& images) {
  Material material;
  material.name = info.name;
  material.base_color = info.base_color;
  material.metallic = info.metallic;
  material.roughness = info.roughness;
  material.alpha_mode = alpha_mode_of(info.alpha_mode);
  material.alpha_cutoff = info.alpha_cutoff;
  material.double_sided = info.double_sided;
  material.base_color_image = index_of(info.base_color_image, images);
  material.normal_image = index_of(info.normal_image, images);
  return material;
}

}  // namespace semblante
