#include "core/anatomy/front_relief.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include <glm/common.hpp>

namespace semblante {
namespace {

/// Along the longer side: an ES0 of a body, a thirtieth of its height, has twenty.
constexpr int knots_along = 600;
/// Coarser levels show no face.
constexpr int least_knots = 12;
/// A closed surface covers each knot some times; a hundred times are drawn in a second.
constexpr double most_covered = 100.0 * knots_along * knots_along;

using TrianglePlaces = std::array<glm::dvec3, 3>;

/// The number of knots in the box about a triangle.
double knots_in_box(const FrontGrid& grid, const TrianglePlaces& p) {
  const auto [left, right] = std::minmax({p[0].x, p[1].x, p[2].x});
  const auto [low, high] = std::minmax({p[0].y, p[1].y, p[2].y});
  return (1.0 + (right - left) / grid.step) * (1.0 + (high - low) / grid.step);
}

/// The mean of what is seen at four knots, where at least two see something.
FrontRelief::Level coarser(const FrontRelief::Level& fine) {
  FrontRelief::Level level;
  level.grid = {fine.grid.origin + 0.5 * fine.grid.step, 2.0 * fine.grid.step, (fine.grid.columns + 1) / 2,
                (fine.grid.rows + 1) / 2};
  level.z.assign(level.grid.size(), std::numeric_limits<double>::quiet_NaN());
  for (int row = 0; row < level.grid.rows; ++row) {
    for (int column = 0; column < level.grid.columns; ++column) {
      double sum = 0.0;
      int count = 0;
      for (const auto& [dx, dy] : {std::pair(0, 0), std::pair(1, 0), std::pair(0, 1), std::pair(1, 1)}) {
        if (!fine.grid.is_in(2 * column + dx, 2 * row + dy)) continue;
        const double z = fine.z[fine.grid.at(2 * column + dx, 2 * row + dy)];
        if (std::isnan(z)) continue;
        sum += z;
        ++count;
      }
      if (count >= 2) level.z[level.grid.at(column, row)] = sum / count;
    }
  }
  return level;
}

}  // namespace

double FrontRelief::Level::at(double x, double y) const {
  const double column = std::round((x - grid.origin.x) / grid.step);
  const double row = std::round((y - grid.origin.y) / grid.step);
  const bool is_in = 0.0 <= column && column < grid.columns && 0.0 <= row && row < grid.rows;
  return is_in ? z[grid.at(static_cast<int>(column), static_cast<int>(row))] : std::numeric_limits<double>::quiet_NaN();
}

std::optional<FrontRelief> FrontRelief::draw(const Surface& surface, std::span<const Triangle> triangles,
                                             const glm::dmat3& turn) {
  const auto corners_of = [&](const Triangle& t) {
    const auto place = [&](std::uint32_t v) { return turn * surface.positions[surface.surface_of[v].value()]; };
    return TrianglePlaces{place(t[0]), place(t[1]), place(t[2])};
  };
  glm::dvec3 low(std::numeric_limits<double>::infinity());
  glm::dvec3 high(-low);
  for (const Triangle& t : triangles) {
    for (const glm::dvec3& p : corners_of(t)) {
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
  }
  const double longer = std::max(high.x - low.x, high.y - low.y);
  if (!(longer > 0.0)) return std::nullopt;
  Level fine;
  fine.grid.origin = glm::dvec2(low);
  fine.grid.step = longer / (knots_along - 1);
  fine.grid.columns = 1 + static_cast<int>((high.x - low.x) / fine.grid.step);
  fine.grid.rows = 1 + static_cast<int>((high.y - low.y) / fine.grid.step);
  fine.z.assign(fine.grid.size(), std::numeric_limits<double>::quiet_NaN());
  double covered = 0.0;
  for (const Triangle& t : triangles) {
    const TrianglePlaces corners = corners_of(t);
    covered += knots_in_box(fine.grid, corners);
    if (covered > most_covered) return std::nullopt;
    fine.grid.visit_knots(corners, [&](std::size_t knot, double z) {
      if (!(fine.z[knot] >= z)) fine.z[knot] = z;
    });
  }
  FrontRelief relief;
  relief.levels_.push_back(std::move(fine));
  while (std::min(relief.levels_.back().grid.columns, relief.levels_.back().grid.rows) > least_knots)
    relief.levels_.push_back(coarser(relief.levels_.back()));
  return relief;
}

const FrontRelief::Level& FrontRelief::with_step(double step) const {
  const auto too_coarse =
      std::find_if(levels_.begin(), levels_.end(), [step](const Level& level) { return level.grid.step > step; });
  return too_coarse == levels_.begin() ? levels_.front() : *std::prev(too_coarse);
}

}  // namespace semblante
