#pragma once

#include <optional>
#include <vector>

#include "core/expressions/library.h"
#include "core/types/facing_lips.h"
#include "core/types/feature_points.h"

namespace semblante {

/// Lips that a viseme or an expression closes meet and stop: where the inner points that face each other (2.2
/// and 2.3, 2.6 and 2.8, 2.7 and 2.9) would come nearer than they are apart on this neutral face, both stay behind by
/// as much, but for `lip_give` of `mouth_nose` (MNS0, model units) by which lips give: speakers aim past the contact
/// and press their lips flat, and Eq. 5 takes 15 % of the closing away and adds 15 % of what an expression opens.
/// `gaps`: where the lips meet as measured on the mesh, in place of the way between the points. What heads leave
/// between their lips at rest differs: the same closing that parts pass through each other on one head leaves them open
/// on another.
void stop_at_contact(std::vector<Displacement>& displacements, const FeaturePointSet& points, double mouth_nose,
                     const std::optional<LipGaps>& gaps = std::nullopt);
inline constexpr double lip_give = 0.048;

/// How far back the lower lip goes to the upper teeth differs even more, since heads have teeth close behind their lips
/// or deep in the mouth: the way back of the lower lip's points is scaled so that 2.3 comes `share_to_teeth` of its way
/// to the edge of the upper teeth (9.10); the rest is the lip behind 2.3. At most `most_to_teeth` times what the set
/// says, at least the inverse. Does nothing where either point is not marked.
void reach_upper_teeth(std::vector<Displacement>& displacements, const FeaturePointSet& points);
inline constexpr double share_to_teeth = 0.85;
inline constexpr double most_to_teeth = 2.5;

/// A displacement set of the library on one head: in model units, brought to the teeth if it meets them, stopped at
/// contact.
ModelDisplacements on_face(const DisplacementSet& set, const Fapu& fapu, const FeaturePointSet& points,
                           const std::optional<LipGaps>& gaps = std::nullopt);

}  // namespace semblante
