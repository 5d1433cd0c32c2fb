#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace semblante {

/// Knots across x and y, on which a surface is seen straight from the front: row by row, from the least y and x.
struct FrontGrid {
  glm::dvec2 origin{0.0};  ///< of the first knot
  double step = 0.0;
  int columns = 0, rows = 0;

  [[nodiscard]] std::size_t size() const { return at(0, rows); }
  [[nodiscard]] std::size_t at(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column);
  }
  [[nodiscard]] int column_at(double x) const { return static_cast<int>(std::lround((x - origin.x) / step)); }
  [[nodiscard]] int row_at(double y) const { return static_cast<int>(std::lround((y - origin.y) / step)); }
  [[nodiscard]] bool is_in(int column, int row) const {
    return 0 <= column && column < columns && 0 <= row && row < rows;
  }

  /// Calls `visit(knot, z)` for each knot that a triangle covers, with the triangle's z there.
  template <class Visit>
  void visit_knots(const std::array<glm::dvec3, 3>& p, const Visit& visit) const;
};

template <class Visit>
void FrontGrid::visit_knots(const std::array<glm::dvec3, 3>& p, const Visit& visit) const {
  const double area = (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[2].x - p[0].x) * (p[1].y - p[0].y);
  if (area == 0.0) return;
  const auto [left, right] = std::minmax({p[0].x, p[1].x, p[2].x});
  const auto [low, high] = std::minmax({p[0].y, p[1].y, p[2].y});
  const auto first = [&](double from) { return std::max(0, static_cast<int>(std::ceil(from / step))); };
  for (int row = first(low - origin.y); row < rows; ++row) {
    const double y = origin.y + row * step;
    if (y > high) break;
    for (int column = first(left - origin.x); column < columns; ++column) {
      const double x = origin.x + column * step;
      if (x > right) break;
      const double b = ((x - p[0].x) * (p[2].y - p[0].y) - (p[2].x - p[0].x) * (y - p[0].y)) / area;
      const double c = ((p[1].x - p[0].x) * (y - p[0].y) - (x - p[0].x) * (p[1].y - p[0].y)) / area;
      if (b < 0.0 || c < 0.0 || b + c > 1.0) continue;
      visit(at(column, row), p[0].z + b * (p[1].z - p[0].z) + c * (p[2].z - p[0].z));
    }
  }
}

}  // namespace semblante
