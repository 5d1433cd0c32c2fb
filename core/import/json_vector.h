#pragma once

#include <glm/vec3.hpp>

#include "core/json/json_cursor.h"

namespace semblante::import {

/// Three finite numbers that fit a float32; faults are kept by the cursor.
glm::dvec3 read_vector(const JsonCursor& array);

}  // namespace semblante::import
