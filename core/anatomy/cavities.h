#pragma once

#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "core/anatomy/point_lookup.h"
#include "core/geometry/surface.h"
#include "core/types/rig.h"

namespace semblante {

/// The surface behind the rim of the mouth or of an eye: the inside of lips and cheeks, an eye's socket.
struct Cavity {
  bool is_mouth = false;
  std::vector<SurfaceVertexId> members;  ///< rising; without the rim
  glm::dvec3 middle{0.0};                ///< between the corners of the rim
};

/// The cavities of a part. A rim is the closed line of shortest paths from corner to corner through the points of the
/// upper and the lower lip (or lid), all of them on this part. Behind it lies what no path joins to any feature point
/// away from lips and lids without crossing a rim. Those beside a rim (8.x, folds of lids) do not count: on a coarse
/// mesh, or guessed, one of them may be at a vertex behind it, and would make the inside of the mouth a front. No
/// cavity where the surface ends at the rim, where points are missing, or where a point (a tongue's, on a head whose
/// tongue is a part of its skin) lies behind the rim.
std::vector<Cavity> find_cavities(const Surface& surface, PartId part, std::span<const SurfacePoint> points);

/// #S: whether a vertex of the skin lies in the mouth, behind the lips: farther from the rim than a lip is thick, along
/// the surface. `points`: all of the head; `eye_separation`: ES0, model units. Empty without a mouth that has an
/// inside.
std::vector<bool> inside_of_mouth(const Surface& surface, std::span<const Part> parts,
                                  std::span<const SurfacePoint> points, double eye_separation);

/// How far the inside of the mouth follows the jaw at a place, 0 to 0.85. `from_corners`: its offset from the middle
/// between the corners of the mouth, in ES0. The share falls from the floor of the mouth to its roof and from the lips
/// to the hinge of the jaw: measured on the mouths of two real heads that open, alike on both.
double jaw_share_in_mouth(const glm::dvec3& from_corners);

}  // namespace semblante
