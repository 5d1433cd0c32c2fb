#pragma once

#include <span>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

namespace semblante {

/// The plane that a face is (nearly) its own mirror image in: dot(normal, p) = offset, the normal to the face's left.
struct MirrorPlane {
  glm::dvec3 normal{1.0, 0.0, 0.0};
  double offset = 0.0;

  [[nodiscard]] double distance(const glm::dvec3& p) const;  ///< signed, positive on the left
  [[nodiscard]] glm::dvec3 image(const glm::dvec3& p) const;
};

struct MirrorPair {
  glm::dvec3 left, right;
};

/// The plane that best halves `pairs` and holds `middle`, by least squares; what they leave open is as in the axes of a
/// face that stands upright (normal near +X). Lengths in ES0.
MirrorPlane fit_mirror_plane(std::span<const MirrorPair> pairs, std::span<const glm::dvec3> middle);

/// The same plane moved a little so that the images of `sample`, places on the face, lie on the `surface` as well as
/// can be. Places without a partner near their image (a scar, hair on one side) are left out. Stays at `start` where
/// few have one.
MirrorPlane refine_mirror_plane(const MirrorPlane& start, std::span<const MirrorPair> pairs,
                                std::span<const glm::dvec3> middle, std::span<const glm::dvec3> sample,
                                std::span<const glm::dvec3> surface);

}  // namespace semblante
