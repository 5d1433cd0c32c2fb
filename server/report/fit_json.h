#pragma once

#include <nlohmann/json_fwd.hpp>

#include "core/types/weight_fit.h"

namespace semblante {

/// The member `weight_fit` of the report document (its form is in ../api/openapi.json, `WeightFit`): the error of each
/// shape that `fitted` weights were fitted to, predicted by a fit to the others, beside that of smooth weights. 1 is a
/// face that does not move; null for a shape that does not move the skin.
nlohmann::ordered_json weight_fit_json(const WeightFit& fit);

}  // namespace semblante
