#pragma once

#include <optional>
#include <vector>

#include "core/expressions/library.h"
#include "core/types/facing_lips.h"
#include "core/types/feature_points.h"

namespace semblante {

/// Lips that a viseme or an expression closes meet and stop: where the inner points that face each other (2.2
/// and 2.3, 2.6 and 2.8, 2.7 and 2.9) would come nearer than they are apart on this neutral face, both stay behind by
/// as much, but for `lip_give` of `mouth_nose` (MNS0, model units) by which lips give. `gaps`: where the
/// lips meet as measured on the mesh, in place of the way between the points. What heads leave between their
/// lips at rest differs: the same closing that parts pass through each other on one head leaves them open on another.
void stop_at_contact(std::vector<Displacement>& displacements, const FeaturePointSet& points, double mouth_nose,
                     const std::optional<LipGaps>& gaps = std::nullopt);
inline constexpr double lip_give = 0.004;

/// A displacement set of the library on one head: in model units, stopped at contact.
ModelDisplacements on_face(const DisplacementSet& set, const Fapu& fapu, const FeaturePointSet& points,
                           const std::optional<LipGaps>& gaps = std::nullopt);

}  // namespace semblante
