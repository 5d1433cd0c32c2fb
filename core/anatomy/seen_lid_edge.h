#pragma once

#include <optional>
#include <span>

#include <glm/vec3.hpp>

#include "core/geometry/similarity.h"
#include "core/geometry/surface.h"
#include "core/types/model.h"
#include "core/types/rig.h"

namespace semblante {

/// The edge of a lid as it is seen straight from the front at the x of one of its points: where the skin ends and the
/// eyeball begins.
struct SeenLidEdge {
  glm::dvec3 place{0.0};  ///< in the frame
  double share = 0.0;     ///< of the way from the lid's point to the other lid's
  double way = 0.0;       ///< that way: the difference of both points' heights
};

/// `frame` maps positions of `surface` to an upright face; `point` and `other`, the points of one eye's lids, are in
/// it. `triangles` are of file vertices. Empty if no eyeball is seen between the points: the eye is closed, or has no
/// ball.
std::optional<SeenLidEdge> seen_lid_edge(const Surface& surface, std::span<const Part> parts,
                                         std::span<const Triangle> triangles, const Similarity& frame,
                                         const glm::dvec3& point, const glm::dvec3& other);

/// Skin between a lid's point and the eye that is seen, as a share of the way to the other lid's point, from which on
/// the point lies on the fold of the lid. On heads whose points are on the edges it is below 0.1.
inline constexpr double least_share_of_fold = 0.15;

/// The greatest span of heights between `low` and `high` at one x at which an eyeball is seen from the front: its upper
/// and lower end, on the edges of the lids. Empty if none is seen, or if the span has no end.
struct SeenEye {
  glm::dvec3 upper{0.0}, lower{0.0};  ///< in the frame
};
std::optional<SeenEye> seen_eye(const Surface& surface, std::span<const Part> parts,
                                std::span<const Triangle> triangles, const Similarity& frame, double x, double low,
                                double high);

/// Whether a lid's point counts as lying on the edge of the lid, not on the fold beside it. `off`: its height above or
/// below the edge; `open`: the height of the open eye; `eye_separation`: ES0. All three in the frame.
bool is_on_edge(double off, double open, double eye_separation);

}  // namespace semblante
