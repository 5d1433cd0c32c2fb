#pragma once

#include <functional>

#include "core/anatomy/cavities.h"
#include "core/geometry/surface.h"
#include "core/parametrize/weight_row.h"
#include "core/types/weight_table.h"

namespace semblante {

using RowOfVertex = std::function<const WeightRow&(SurfaceVertexId)>;

/// The shares of the points in the members of a cavity, in their order.
///
/// The rows continue those of the rim smoothly and give way, within a length that is short in an eye's socket and
/// longer in the mouth, to a row of their own: none in the socket, that of the skull. In the mouth the back of the lips
/// follows the points around it as their front does; farther in, the inside of lips and chin follows the skin in front
/// of it, as far as the flesh between them is thin; the rest follows the jaw (2.1), as jaw_share_in_mouth says. They
/// are the solution of (Laplacian of w) = (w - own row) / length^2 on the graph of edges, so they are not negative and
/// their sums are at most one.
///
/// `row_of`: the row of a vertex without cavities; the same reference for each question about a vertex. `unit`: ES0 in
/// model units. Rows have at most `max_smooth_influences` points.
WeightTable<double> cavity_rows(const Surface& surface, const Cavity& cavity, double unit, const RowOfVertex& row_of);

}  // namespace semblante
