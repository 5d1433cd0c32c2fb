#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "core/expressions/library.h"
#include "core/types/feature_points.h"
#include "core/types/result.h"

namespace semblante {

struct ExtractOptions {
  /// Remove the motion of the whole head first, estimated from vertices without another motion (head_motion.h). By
  /// default the meshes are compared in place, as in the paper.
  bool align = false;
  /// A point that moves by less than this many units along every axis is omitted, because by Eq. 5 a point in the set
  /// reduces the effect of another set that moves it. One unit is the resolution of a FAP.
  double least = 1.0;
  /// The strength at which the example shows the expression, from least_strength to most_strength: displacements are
  /// divided by it.
  double strength = 1.0;
};

inline constexpr double least_strength = 0.01;
inline constexpr double most_strength = 100.0;

/// The motion removed by `align`.
struct RemovedMotion {
  double degrees = 0.0;   ///< the angle of the turn, never negative
  double distance = 0.0;  ///< displacement of the centre of the still vertices, model units
};

struct Extraction {
  std::vector<Displacement> displacements;  ///< FAPU units, sorted by point; none is zero
  std::vector<MissingUnit> skipped;      ///< moved points omitted because of a missing FAPU, with the first missing one
  std::vector<FeaturePointId> at_rest;   ///< marked points that move by less than `least`
  std::vector<FeaturePointId> bare;      ///< bare positions (7.1, a pupil inside a triangle): they follow no vertex
  std::vector<FeaturePointId> unmarked;  ///< of the 84, those the head does not have
  std::optional<RemovedMotion> removed;
};

/// A displacement set from an example (algorithm, section 8): for each marked point the difference of its vertex
/// between the two shapes of one mesh, each component divided by the head's FAPU for that point and axis (fapu_of).
///
/// `neutral` and `expression`: #V file vertices each, model units, both in the MPEG-4 frame. `points` and `fapu`: of
/// the neutral head. Errors: `mismatch` of the numbers of vertices; `not_finite` (where: "vertex 12"); `out_of_range`
/// for a displacement beyond most_set_units; `invalid_argument` for an option, and if `align` finds no still
/// vertices; `empty` when no point moves.
Result<Extraction> extract_displacements(const FeaturePointSet& points, const Fapu& fapu,
                                         std::span<const glm::vec3> neutral, std::span<const glm::vec3> expression,
                                         const ExtractOptions& options = {});

/// Describes the extraction in sentences: the omitted points with reasons. Empty when no point is
/// omitted.
std::vector<std::string> explain(const Extraction& extraction);

}  // namespace semblante
