#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/anatomy/point_lookup.h"
#include "core/geometry/surface.h"
#include "core/types/rig.h"

namespace semblante {

/// The edge of a lid from corner to corner, through its middle point.
struct LidEdge {
  static constexpr std::size_t inner = 0;
  static constexpr std::size_t outer = 1;
  SurfacePoint middle;
  std::array<SurfacePoint, 2> corners;                    ///< inner, outer
  std::array<std::vector<SurfaceVertexId>, 2> to_corner;  ///< shortest paths from the middle
  /// Or at the vertex of its part that is nearest to the corner, or at the outermost one of the opening.
  std::array<bool, 2> ends_at_corner{};
};

/// The height of an eye's opening as a share of its width below which its lids are closed. Open eyes have 0.2 and more.
inline constexpr double closed_height = 0.04;

/// Both edges of one eye. Points are those of the standard (left: 3.1, 3.3, corners 3.11 and 3.7). On a coarse mesh the
/// point of a corner may be one vertex along a lid: the edges then meet at the outermost vertex of the opening, and
/// that lid's edge leads through the point.
struct EyeEdges {
  LidEdge upper, lower;
};

/// The edges of an eye (0 left, 1 right). Empty if a point is not on the surface, or if a corner is too far from the
/// part of a lid. With `parts`, the edges stay before the eyeball: a corner that is marked inside a lid is reached from
/// the edge that is seen, not along the inside.
std::optional<EyeEdges> find_eye_edges(const Surface& surface, std::span<const SurfacePoint> points, std::size_t eye,
                                       std::span<const Part> parts = {});

}  // namespace semblante
