#pragma once

#include <nlohmann/json_fwd.hpp>

#include "core/types/articulation.h"

namespace semblante {

/// The member `articulation` of the report document (its form is in ../api/openapi.json, `Report`).
nlohmann::ordered_json articulation_json(const Articulation& articulation);

}  // namespace semblante
