#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/geometry/surface.h"
#include "core/types/feature_points.h"
#include "core/types/marked_point.h"
#include "core/types/model.h"
#include "core/types/result.h"
#include "core/types/rig.h"

namespace semblante {

/// Matches marked points with a model. The result is sorted by id.
///
/// - A vertex: that file vertex. If positions are given too and some disagree (more than 1e-3 of the box diagonal away)
///   while every disagreeing point has a vertex at its position (within 1e-4), the file's vertices were renumbered and
/// the positions win. Otherwise the vertices win. Both cases give a warning in `warnings`.
/// - A position alone: pupils (3.5, 3.6) stay bare positions, because they move with the eyeball and not the surface.
///   For the others a vertex within 1e-4 of the diagonal (of several, the one on the part with the most vertices,
///   then the lowest file vertex). Otherwise 7.1 stays a bare position, and any other point is at the nearest place of
///   the surface within 5 % of the diagonal: at a vertex if one is meant (meant_corner), else between vertices, with
///   `FeaturePoint::between`. A warning if that is more than 1e-3 of the diagonal away.
/// - The position of a point of a lip or lid where the rims touch: of the vertices at its position one on its own side.
///   Nor is it on a triangle of the other side. Both only if the other points determine the sides (RimSides).
///
/// Errors carry `where` = "/points/<id>" (or below it): `out_of_range` vertex, `not_finite` position, `missing` both,
/// `invalid_argument` for a point given twice, too far from the surface, or on a part it cannot be on (a skin point on
/// an eye, teeth or tongue, by `roles_by_user` or clear from the part's own points).
Result<FeaturePointSet> place_feature_points(const Model& model, const Surface& surface,
                                             std::span<const MarkedPoint> marked, std::vector<std::string>* warnings,
                                             std::span<const std::optional<PartRole>> roles_by_user = {});

}  // namespace semblante
