#pragma once

#include <iosfwd>

#include "core/pipeline/rigged.h"

namespace semblante {

/// {"weights": "smooth", "metric": "edge", "shares": true,
///  "points": ["2.1", ...], "vertices": [[["2.1", 0.25], ...], ...]}: how the weights were made, the marked points in
///  rising order, and one row of weights per file vertex. `shares` says
/// what the numbers are: false, W of Eq. 4, before the quotient of Eq. 7, so that a vertex moves by the sum of W * D
/// divided by the sum of W; true, the shares themselves, so that it moves by the sum of W * D. Fitted weights also have
/// "fit", as weight_fit_json. Numbers are the shortest
/// that read back as the same double.
void write_weights_json(const Rig& rig, const RigRequest& made, std::ostream& out);

}  // namespace semblante
