#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/anatomy/point_lookup.h"
#include "core/geometry/surface.h"
#include "core/types/feature_points.h"
#include "core/types/model.h"
#include "core/types/rig.h"

namespace semblante {

/// The parts of a model by PartId, with their roles: those set by the user, else guesses from the points marked on a
/// part, its name, its place and its size. Both eyeballs in one part are `rest`: it has no single pivot. `points` may
/// be empty: then only names, places and sizes are used.
std::vector<Part> describe_parts(const Model& model, const Surface& surface, const FeaturePointSet& points,
                                 std::span<const std::optional<PartRole>> roles_by_user = {});

/// Whether a part has this role.
bool has_part(std::span<const Part> parts, PartRole role);

/// The part with this role that has the most vertices; empty without one.
std::optional<PartId> largest_part(std::span<const Part> parts, PartRole role);

/// The role of an eyeball (0 left, 1 right).
constexpr PartRole eyeball_role(std::size_t eye) { return eye == 0 ? PartRole::left_eye : PartRole::right_eye; }

/// True for the points that can only lie on skin: groups 2, 4, 5, 8, 10, the lids (3.1-3.4, 3.7-3.14) and the nose
/// (9.1-9.7, 9.12-9.15).
bool is_skin_point(FeaturePointId id);

/// The role of a part that follows with certainty from its own points: a part with a pupil, a tongue or a teeth point
/// that is not the skin. Empty for every other part. #P entries.
std::vector<std::optional<PartRole>> roles_clear_from_points(const Surface& surface,
                                                             std::span<const SurfacePoint> points);

}  // namespace semblante
