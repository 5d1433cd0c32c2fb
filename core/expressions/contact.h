#pragma once

#include <optional>
#include <vector>

#include "core/expressions/library.h"
#include "core/types/articulation.h"
#include "core/types/facing_lips.h"
#include "core/types/feature_points.h"

namespace semblante {

/// Stops lips that a viseme or an expression closes at their contact: if facing inner points (2.2 and 2.3, 2.6 and 2.8,
/// 2.7 and 2.9) would close more than their gap on this neutral face, both displacements are reduced equally, except
/// for `lip_give` of `mouth_nose` (MNS0, model units), by which lips yield: speakers aim beyond the contact and press
/// their lips flat, and Eq. 5 removes 15 % of the closing and adds 15 % of an expression's opening. `gaps`: the gaps
/// measured on the mesh, instead of the distances between the points; lips of one skin (`joined`) do not yield. The gap
/// between the lips at rest differs between heads: the same closing makes lips pass through each other on one head and
/// leaves them open on another.
void stop_at_contact(std::vector<Displacement>& displacements, const FeaturePointSet& points, double mouth_nose,
                     const std::optional<LipGaps>& gaps = std::nullopt);
inline constexpr double lip_give = 0.048;

/// Scales the backward displacement of the lower lip's points to this head's distance of lips and teeth, which differs
/// even more: 2.3 moves by `share_to_teeth` of its distance to the edge of the upper teeth (9.10); the rest is the lip
/// behind 2.3. The scale is at most `most_to_teeth`, at least its inverse. Does nothing if either point is not marked.
void reach_upper_teeth(std::vector<Displacement>& displacements, const FeaturePointSet& points);
inline constexpr double share_to_teeth = 0.85;
inline constexpr double most_to_teeth = 2.5;

/// Moves the fold of an upper lid at least as far as it goes along with a near brow (`folds_below_near_brows`), where
/// the set moves both up or both down: the fold of the library's sets is that of faces whose brows are far.
void follow_near_brows(std::vector<Displacement>& displacements, const FeaturePointSet& points);

/// Moves a cheek partly as the near corner of the mouth beside it (`cheeks_beside_near_corners`), where the set moves
/// both: the library's sets are made for faces whose cheeks are far from the corners.
void follow_near_corners(std::vector<Displacement>& displacements, const FeaturePointSet& points);

/// Moves a fold of a lid partly as the near edge (`folds_beside_near_edges`), where the set moves both, likewise.
void follow_near_edges(std::vector<Displacement>& displacements, const FeaturePointSet& points);

/// Lids do not open (3.1 and 3.2 not up, 3.3 and 3.4 not down): eyes that are closed on the neutral face stay so in
/// expressions, which would open them to a slit. FAPs 19 to 22 open them.
void keep_lids_shut(std::vector<Displacement>& displacements);

/// The units in which a face wears the library's sets, whose values are those of people: a mouth that is far below the
/// nose but narrow, as at the end of a muzzle, would smile higher than it is wide, and brows above a long muzzle would
/// fold the forehead; under a nose that hangs to the lip the jaw would hardly open. ENS is at most `most_nose_of_eyes`
/// of ES, MNS at most `most_lip_of_mouth` of MW and at least the lesser of `least_lip_of_mouth` of MW and
/// `least_lip_of_eyes` of ES; units given by hand stay as they are.
Fapu units_of_library(const Fapu& fapu);
/// The greatest of people: eyes to nose 52 mm for pupils 58 mm apart, nose to mouth 27 mm for a mouth 45 mm wide.
inline constexpr double most_nose_of_eyes = 0.9;
inline constexpr double most_lip_of_mouth = 0.6;
/// The least of people: nose to mouth 17 mm for a mouth 62 mm wide and pupils 74 mm apart.
inline constexpr double least_lip_of_mouth = 0.27;
inline constexpr double least_lip_of_eyes = 0.23;

/// The set with its opening of the jaw multiplied by `articulation`, at the points that it moves. FAPU units.
std::vector<Displacement> articulated(const DisplacementSet& set, double articulation);

/// A displacement set on one head: in model units, articulated, scaled to meet the teeth if the set does, stopped at
/// contact. If it is of the library, its units are `units_of_library`, folds of lids go along with near brows
/// and edges, cheeks with near corners of the mouth, and closed eyes stay closed.
ModelDisplacements on_face(const DisplacementSet& set, const Fapu& fapu, const FeaturePointSet& points,
                           const std::optional<LipGaps>& gaps = std::nullopt, double articulation = usual_articulation);

}  // namespace semblante
