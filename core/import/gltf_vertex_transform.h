#pragma once

#include <memory>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "core/import/gltf_scene.h"

namespace semblante::import {

/// Transforms the vertices of one primitive: not at all, by one matrix, or each by its joints.
class VertexTransform {
 public:
  /// A null placement (a mesh outside the scene) means no transform.
  explicit VertexTransform(const MeshPlacement* placement);

  [[nodiscard]] bool moves() const { return !is_identity_; }
  [[nodiscard]] bool wants_joints() const { return joints_ != nullptr; }
  /// Adds a set of four joints and weights per vertex (#V by 4 each). Joints out of range are ignored.
  void add_joints(const std::vector<float>& joints, const std::vector<float>& weights);
  /// Whether the transform reverses the orientation of the surface.
  [[nodiscard]] bool mirrors() const;

  /// Exact if there is no transform.
  [[nodiscard]] glm::vec3 position(std::size_t vertex, const glm::vec3& value) const;
  /// Transforms a displacement of a vertex.
  [[nodiscard]] glm::vec3 displacement(std::size_t vertex, const glm::vec3& value) const;
  /// Transforms a normal to unit length, or to zero if it has no direction.
  [[nodiscard]] glm::vec3 normal(std::size_t vertex, const glm::vec3& value) const;

 private:
  struct Influence {
    std::uint32_t joint = 0;
    float weight = 0.0F;
  };
  [[nodiscard]] glm::dmat4 matrix(std::size_t vertex) const;

  bool is_identity_ = true;
  glm::dmat4 to_world_{1.0};
  std::shared_ptr<const std::vector<glm::dmat4>> joints_;  ///< null: to_world_ moves all
  std::vector<std::vector<Influence>> sets_;               ///< each #V by 4
};

}  // namespace semblante::import
