#pragma once

#include <span>

#include "core/anatomy/modelled_eye.h"
#include "core/anatomy/opening_margins.h"
#include "core/geometry/surface.h"
#include "core/parametrize/greatest_weights.h"
#include "core/parametrize/point_distances.h"
#include "core/parametrize/weight_prior.h"
#include "core/types/weight_table.h"

namespace semblante {

/// The length that distances are measured in: `eye_separation`, ES0 in model units, or the spread of the part's points
/// where it is not positive (unknown) or far greater than that spread.
double weight_unit(const PointDistances& distances, double eye_separation);

/// The weights of `WeightMethod::smooth` for the members of one part: #M rows of at most `max_smooth_influences`
/// positive weights. Unlike W of Eq. 4 they are the shares themselves: D_P = sum(w D), and the remainder of a row to
/// one belongs to a root that does not move. They are continuous over the surface, reach exactly zero about one
/// `eye_separation` away from the last point, and are exactly (id, 1) at a point's own vertex (points that share a
/// vertex share the one equally).
///
/// `eye_separation`: as weight_unit takes it, whose length makes the weights independent of scale. `prior`: corrections
/// learned from other heads. `modelled`: eyes in the skin, whose held vertices follow nothing.
WeightTable<double> smooth_part_weights(const Surface& surface, const PointDistances& distances, double eye_separation,
                                        std::span<const MarginSite> margins = {},
                                        const WeightPrior& prior = trained_weight_prior(),
                                        const ModelledEyes& modelled = {});

}  // namespace semblante
