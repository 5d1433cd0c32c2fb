#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "core/anatomy/point_lookup.h"
#include "core/geometry/sphere_fit.h"
#include "core/geometry/surface.h"
#include "core/tables/openings.h"
#include "core/types/model.h"
#include "core/types/rig.h"

namespace semblante {

/// A path along the surface from a point of an upper lip or lid to the opposite point of the lower one.
struct RimCrossing {
  SurfacePoint upper, lower;
  double share = 0.0;                ///< its length as a fraction of the straight way around the nearer corner
  std::vector<SurfaceVertexId> way;  ///< from the lower point to the upper one; empty if there is no path
};

/// Rims with a slit between them: the path leads around a corner or deep inside. Below this share it crosses the gap:
/// the rims are fused, bridged by a membrane, or the bottom of a hollow so shallow that closing folds it. On 20 heads
/// of other makers open rims have at least 0.93, and the others at most 0.74.
inline constexpr double joined_share = 0.8;

/// The pair of opposite points of an opening with the least `share`; empty without such a pair or without corners.
std::optional<RimCrossing> shortest_crossing(const Surface& surface, const mpeg4::Opening& opening,
                                             std::span<const SurfacePoint> points);

/// Whether a path joins the rims. One that leads behind `ball`, the eyeball, does not: it crosses the floor of a
/// shallow socket, which may fold because nobody sees it.
bool joins(const RimCrossing& crossing, const Surface& surface, const std::optional<Sphere>& ball = std::nullopt);

/// Whether the rims of an opening are one skin.
bool are_joined(const Surface& surface, const mpeg4::Opening& opening, std::span<const SurfacePoint> points,
                const std::optional<Sphere>& ball = std::nullopt);

/// The vertical displacement of each feature point, model units; zero for those that do not move.
using Heights = std::array<double, feature_point_count>;

/// The share of `heights`, at most 1, by which the points can move before the skin between them folds over itself. Seen
/// from the front, the triangles that would turn over on the whole way keep a third of their area, but for a hundredth
/// of what all triangles lose. Reads the parts and the influence of `rig`, whose rows are those of the file vertices.
double share_before_fold(const Model& model, const Rig& rig, const Heights& heights);

}  // namespace semblante
