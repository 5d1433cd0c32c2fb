#pragma once

#include <iosfwd>

#include "core/pipeline/rigged.h"

namespace semblante {

/// Writes the weights of a rig as one JSON object:
///
///     {"weights": "smooth", "metric": "edge", "shares": true,
///      "points": ["2.1", ...], "vertices": [[["2.1", 0.25], ...], ...]}
///
/// `weights` and `metric` are the method, `points` the marked points in ascending order, `vertices` one row of weights
/// per file vertex, and after them one per vertex of a point between vertices. If `shares` is false, the numbers are
/// the weights W of Eq. 4: a vertex moves by sum(W * D) / sum(W) (Eq. 7). If true, they are normalized: a vertex moves
/// by sum(W * D). Fitted weights also have `fit`, in the form of weight_fit_json. Numbers are written with the fewest
/// digits that read back as the same double.
void write_weights_json(const Rig& rig, const RigRequest& made, std::ostream& out);

}  // namespace semblante
