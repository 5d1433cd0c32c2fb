#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/anatomy/mirror_plane.h"
#include "core/anatomy/rim_sides.h"
#include "core/propose/face_surface.h"

namespace semblante {

struct RimVertex {
  std::uint32_t vertex;
  std::string doubt;  ///< why its side may be wrong, as text; empty: its side is certain
};

/// What is to be distinguished: "the upper lip from the lower lip".
std::string sides_in_words(const mpeg4::Opening& opening);

/// The doubt about a vertex near which the surface connects both sides.
std::string undistinguished(const mpeg4::Opening& opening);

/// Chooses vertices for points of lips and lids: the nearest vertex on the point's own side along the surface
/// (RimSides).
class RimChoice {
 public:
  /// Keeps references to both. `anchors` may grow until the first choice for an opening.
  RimChoice(const FaceSurface& face, const std::vector<SurfacePoint>& anchors) : face_(face), anchors_(anchors) {}

  /// The vertex of `role` for a point of an opening, expected at `place` within about `error`. If the surface does not
  /// show which vertices are on the point's side, the nearest vertex, with `doubt` set. Considers only vertices that
  /// pass `is_free`, if given. Empty if the role has no such vertex.
  std::optional<RimVertex> nearest(const RimOfPoint& rim, PartRole role, const glm::dvec3& place, double error,
                                   const MirrorPlane* on, const FaceSurface::Filter& is_free = {});
  /// Whether the surface shows that a vertex is on the other side.
  bool is_surely_beyond(const RimOfPoint& rim, std::uint32_t vertex);

 private:
  const RimSides& sides_of(const mpeg4::Opening& opening);

  const FaceSurface& face_;
  const std::vector<SurfacePoint>& anchors_;
  std::array<std::unique_ptr<RimSides>, mpeg4::openings.size()> sides_;
};

}  // namespace semblante
