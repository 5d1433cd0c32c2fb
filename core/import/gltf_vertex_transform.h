#pragma once

#include <memory>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "core/import/gltf_scene.h"

namespace semblante::import {

/// Puts the vertices of one primitive where its mesh stands: as they are, by one matrix, or each by its joints.
class VertexTransform {
 public:
  /// A mesh that is not shown stays as it is.
  explicit VertexTransform(const MeshPlacement* placement);

  [[nodiscard]] bool moves() const { return !is_identity_; }
  [[nodiscard]] bool wants_joints() const { return joints_ != nullptr; }
  /// One more set of four joints and weights a vertex (#V by 4 each). Joints out of range are left out.
  void add_joints(const std::vector<float>& joints, const std::vector<float>& weights);
  /// Whether it turns the surface inside out.
  [[nodiscard]] bool mirrors() const;

  /// Leaves every bit alone where nothing moves.
  [[nodiscard]] glm::vec3 position(std::size_t vertex, const glm::vec3& value) const;
  /// Where a small step from a vertex leads.
  [[nodiscard]] glm::vec3 displacement(std::size_t vertex, const glm::vec3& value) const;
  /// Unit length, or zero where the normal has no direction, where something moves.
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
