#include "protocol/package/quantization.h"

#include <algorithm>
#include <cmath>

namespace semblante {

float longest_side(const glm::vec3& low, const glm::vec3& high) {
  const glm::vec3 size = high - low;
  return std::max({size.x, size.y, size.z});
}

int position_bits(float side, const Fapu& fapu) {
  const double step = 2.0 * fapu[FapuUnit::es].value_or(0.0);
  if (!(step > 0.0)) return least_position_bits;
  const double bits = std::ceil(std::log2(static_cast<double>(side) / step + 1.0));
  return static_cast<int>(std::clamp<double>(bits, least_position_bits, most_position_bits));
}

}  // namespace semblante
