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

  /// Where a position of the moved shape would be, had the head not moved.
  [[nodiscard]] glm::dvec3 undo(const glm::dvec3& position) const { return still + back * (position - moved); }
  /// The angle of the turn, 0..180.
  [[nodiscard]] double degrees() const;
};

/// The motion of the vertices that move with the head alone, in the least squares. Which those are nobody says: they
/// are the half of the vertices that one rigid motion explains best, found by fitting and dropping the worse half in
/// turn (least trimmed squares). So at least half of the mesh must keep its shape, which the back of a head, its neck
/// and ears do; a mask of the face alone has no such half when all of it moves. Empty for fewer than 8 vertices, or
/// still ones that lie on a line. `neutral` and `moved`: #V, finite. Time bounded: of many vertices 20 000 are looked
/// at.
std::optional<HeadMotion> find_head_motion(std::span<const glm::vec3> neutral, std::span<const glm::vec3> moved);

}  // namespace semblante
