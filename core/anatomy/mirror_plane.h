#pragma once

#include <span>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

namespace semblante {

/// The (approximate) plane of symmetry of a face: dot(normal, p) = offset, with the normal to the face's left.
struct MirrorPlane {
  glm::dvec3 normal{1.0, 0.0, 0.0};
  double offset = 0.0;

  [[nodiscard]] double distance(const glm::dvec3& p) const;  ///< signed, positive on the left
  [[nodiscard]] glm::dvec3 image(const glm::dvec3& p) const;
};

struct MirrorPair {
  glm::dvec3 left, right;
};

/// The least squares plane that bisects `pairs` and contains `middle`; undetermined directions are those of an upright
/// face (normal near +X). Lengths in ES0.
MirrorPlane fit_mirror_plane(std::span<const MirrorPair> pairs, std::span<const glm::dvec3> middle);

/// Refines a plane so that the mirror images of `sample`, places on the face, are as close as possible to the
/// `surface`. Places without a match near their image (a scar, hair on one side) are excluded. Returns `start` if there
/// are too few matches.
MirrorPlane refine_mirror_plane(const MirrorPlane& start, std::span<const MirrorPair> pairs,
                                std::span<const glm::dvec3> middle, std::span<const glm::dvec3> sample,
                                std::span<const glm::dvec3> surface);

}  // namespace semblante
