#include "tests/golden/extract/turned_scan.h"

#include <cmath>
#include <numbers>

namespace semblante::testing {

std::vector<glm::vec3> turned_scan(const std::vector<glm::vec3>& shape, double degrees, const glm::dvec3& shift) {
  const double angle = degrees * std::numbers::pi / 180.0;
  std::vector<glm::vec3> moved;
  moved.reserve(shape.size());
  for (const glm::dvec3 p : shape) {
    moved.emplace_back(
        glm::dvec3(p.x, std::cos(angle) * p.y - std::sin(angle) * p.z, std::sin(angle) * p.y + std::cos(angle) * p.z) +
        shift);
  }
  return moved;
}

double relative_error(const std::vector<Displacement>& got, const std::vector<Displacement>& expected) {
  const auto a = to_dense(got);
  const auto b = to_dense(expected);
  double error = 0.0, size = 0.0;
  for (std::size_t i = 0; i < b.size(); ++i) {
    error += std::pow(a[i] - b[i], 2);
    size += std::pow(b[i], 2);
  }
  return std::sqrt(error / size);
}

}  // namespace semblante::testing
