#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "core/types/model.h"
#include "core/types/result.h"
#include "protocol/package/mesh_slices.h"

namespace semblante {

/// A joint of glTF, relative to its parent.
struct GltfJoint {
  std::string name;
  std::optional<std::size_t> parent;  ///< a joint before this one; empty: the root of the skeleton
  glm::vec3 translation{0.0F};
  glm::quat rotation{1.0F, 0.0F, 0.0F, 0.0F};
  glm::mat4 inverse_bind{1.0F};
};

/// One property of one joint over time.
struct GltfChannel {
  enum class Path : std::uint8_t { translation, rotation, scale };
  std::size_t joint = 0;
  Path path = Path::translation;
  std::vector<float> times;   ///< #keys, seconds, rising
  std::vector<float> values;  ///< #keys by 3, of a rotation by 4: x, y, z, w
};

/// Builds a glTF 2.0 document: one mesh named "face" in one scene, its materials and images. Hides tinygltf's types.
class GltfBuilder {
 public:
  GltfBuilder(const std::vector<Material>& materials, const std::vector<Image>& images);
  ~GltfBuilder();
  GltfBuilder(const GltfBuilder&) = delete;
  GltfBuilder& operator=(const GltfBuilder&) = delete;

  Status add_draco_primitive(const Slice& slice, const std::vector<SliceAttribute>& attributes);
  void add_plain_primitive(const Slice& slice, const std::vector<SliceAttribute>& attributes);
  /// Adds the rig document as extension SEMBLANTE_face of the scene.
  void set_rig(const std::string& rig_json);
  /// Adds the skeleton beside the mesh, and the mesh's skin. At most once.
  void set_skin(std::span<const GltfJoint> joints);
  /// Adds an animation with linear interpolation and at least one channel. After set_skin.
  void add_animation(const std::string& name, std::span<const GltfChannel> channels);
  /// Sets data without a place in glTF, as a JSON object.
  void set_asset_extras(const std::string& json);

  /// Returns the GLB. To be called once, at the end.
  Result<std::vector<std::uint8_t>> finish();

 private:
  class Content;
  std::unique_ptr<Content> content_;
};

}  // namespace semblante
