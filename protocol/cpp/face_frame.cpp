#include "protocol/cpp/face_frame.h"

#include <algorithm>

namespace semblante {

bool is_valid(const FaceFrame& state) {
  const auto& [viseme, expression, level] = state;
  if (viseme.select1 > max_viseme || viseme.select2 > max_viseme || viseme.blend > max_blend) return false;
  if (expression.select1 > max_expression || expression.select2 > max_expression) return false;
  if (expression.intensity1 > max_blend || expression.intensity2 > max_blend) return false;
  return std::none_of(level.begin(), level.end(), [](std::int16_t value) { return value == INT16_MIN; });
}

}  // namespace semblante
