#pragma once

#include <glm/vec3.hpp>

#include "core/json/json_cursor.h"

namespace semblante::import {

/// Three finite numbers within the range of float32; errors are reported by the cursor.
glm::dvec3 read_vector(const JsonCursor& array);

}  // namespace semblante::import
