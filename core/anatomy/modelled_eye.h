#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "core/anatomy/point_lookup.h"
#include "core/geometry/sphere_fit.h"
#include "core/geometry/surface.h"
#include "core/types/model.h"
#include "core/types/rig.h"

namespace semblante {

/// An eye that is modelled in the skin, as on sculptures and scans: no part of its own, but a patch between the lids
/// that is smooth and ends in a groove where the lids step forward. Lids close over it while it stays. A
/// ball that goes on behind the lids and shares some vertices with them counts as one too: converters that merge near
/// vertices make such eyes.
struct ModelledEye {
  /// A place on the edge of a lid, as it is seen from the front.
  struct RimPlace {
    SurfaceVertexId vertex;
    bool is_upper;
    double share;  ///< of the way of the lid's middle point until both lids meet here; 0 to 1
  };
  std::vector<SurfaceVertexId> held;  ///< that stay: vertices all of whose triangles belong to the eye; rising
  std::vector<RimPlace> rim;
  glm::dvec3 upper{0.0}, lower{0.0};  ///< where the eye that is seen ends, above and below, near the upper lid's point
  std::optional<Sphere> ball;         ///< empty: the eye is too flat for one
  bool is_welded = false;             ///< a ball that goes on behind the lids and shares vertices with them
};

/// Left, right.
using ModelledEyes = std::array<std::optional<ModelledEye>, 2>;

/// Whether one of the eyes holds a vertex.
bool is_held(const ModelledEyes& eyes, SurfaceVertexId vertex);

/// The modelled eyes of a head: those that have no part of their own. Where the lids are one skin (`are_joined`) the
/// eye ends in a groove, else it is a ball that goes on behind them. An eye is empty if a point of its lids is missing
/// or lies on it (a corner on the ball too), or if no smooth patch fills most of the opening between the points: a
/// membrane, nothing at all, or a mesh that is too coarse. `triangles` are of file vertices.
ModelledEyes find_modelled_eyes(const Surface& surface, std::span<const Triangle> triangles,
                                std::span<const Part> parts, std::span<const SurfacePoint> points);

}  // namespace semblante
