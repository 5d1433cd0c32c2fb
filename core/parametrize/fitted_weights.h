#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/anatomy/modelled_eye.h"
#include "core/anatomy/opening_margins.h"
#include "core/geometry/surface.h"
#include "core/parametrize/point_distances.h"
#include "core/types/example.h"
#include "core/types/progress.h"
#include "core/types/result.h"
#include "core/types/weight_fit.h"
#include "core/types/weight_table.h"

namespace semblante {

/// The weights of `WeightMethod::fitted` for the members of one part, and how well they predict.
struct FittedWeights {
  WeightTable<double> rows;        ///< #M rows, as those of smooth_part_weights
  std::vector<ShapeError> errors;  ///< by shape, of every `sample_every`-th member
};

/// How far the row of each member (#M) may leave its smooth row, 0..1: not at all on the edges of lips and lids, so
/// that mouth and eyes still shut, and fully about a tenth of `unit` away from them. What is held of an eye that is
/// modelled in the skin stays.
std::vector<double> freedom_of_members(const Surface& surface, const PointDistances& distances,
                                       std::span<const MarginSite> margins, double unit,
                                       const ModelledEyes& modelled = {});

/// Fits the weights of one part to shapes of the head itself. In a shape the points move as their vertices do, and
/// Eq. 7 predicts the displacement of every other vertex from theirs. The row of a vertex minimizes
///
///     sum over shapes of |D - sum(w_k D_k)|^2 / size  +  ridge * sum of (w_k - g_k)^2 (1 + (d_k / length)^2)
///
/// over w >= 0; of the difference to the smooth row the share `freedom` is taken. Here D and D_k are the displacements
/// of the vertex and of point k, size is the sum of |D_k|^2 over the points, g are the smooth weights and d_k the
/// distance to point k along the surface. Then the row is scaled to a sum of one if it is more, and keeps the eight
/// greatest weights. The minimum is unique and continuous in g, d and D, so weights are as continuous over the surface
/// as the shapes; at a point's own vertex they are exactly that point.
///
/// `smooth`: the rows of smooth_part_weights. `freedom`: #M. `shapes`: by member (shapes_of_members), finite; one that
/// moves no point is ignored. `unit`: the length of smooth_part_weights. The time of the errors grows with #shapes
/// * #M / sample_every, that of the weights with #M. Fails only with `cancelled`.
Result<FittedWeights> fit_part_weights(const PointDistances& distances, const WeightTable<double>& smooth,
                                       std::span<const double> freedom, std::span<const Example> shapes, double unit,
                                       std::size_t sample_every = 1, const Progress& progress = {});

}  // namespace semblante
