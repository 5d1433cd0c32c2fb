#include "core/import/json_vector.h"

#include <cmath>
#include <limits>

namespace semblante::import {

glm::dvec3 read_vector(const JsonCursor& array) {
  glm::dvec3 value(0.0);
  if (array.size() != 3) {
    array.fail(ErrorCode::malformed, "must have 3 numbers");
    return value;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const JsonCursor element = array.element(i);
    value[static_cast<int>(i)] = element.number();
    if (std::abs(value[static_cast<int>(i)]) > static_cast<double>(std::numeric_limits<float>::max())) {
      element.fail(ErrorCode::out_of_range, "is too large");
    }
  }
  return value;
}

}  // namespace semblante::import
