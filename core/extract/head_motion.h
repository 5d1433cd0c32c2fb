#pragma once

#include <optional>
#include <span>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace semblante {

/// A rigid motion of the whole head between two shapes of one mesh.
struct HeadMotion {
  glm::dmat3 back{1.0};   ///< turns what moved back
  glm::dvec3 still{0.0};  ///< middle of the still vertices in the neutral shape
  glm::dvec3 moved{0.0};  ///< the same in the other

  /// The position in the moved shape without the motion of the head.
  [[nodiscard]] glm::dvec3 undo(const glm::dvec3& position) const { return still + back * (position - moved); }
  /// The angle of the rotation, 0..180.
  [[nodiscard]] double degrees() const;
};

/// The least squares motion of the vertices that move only with the head. These are estimated as the half of the
/// vertices that fits one rigid motion best, by repeatedly fitting and dropping the worse half (least trimmed squares).
/// So at least half of the mesh must keep its shape, as do the back of a head, its neck and ears; a mask of the face
/// has no such half if all of it moves. Empty for fewer than 8 vertices, or collinear still ones. `neutral` and
/// `moved`: #V, finite. The time is bounded: of large meshes 20 000 vertices are sampled.
std::optional<HeadMotion> find_head_motion(std::span<const glm::vec3> neutral, std::span<const glm::vec3> moved);

}  // namespace semblante
