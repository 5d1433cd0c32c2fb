#include "core/propose/seen_opening.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/anatomy/seen_lid_edge.h"

namespace semblante {
namespace {

/// The height of an open eye, as a share of its width.
constexpr double least_open = 0.15;

/// The columns on both sides of the middle of an eye in which its ball is seen, without a gap, with their x: from right
/// to left.
std::vector<std::pair<double, SeenEye>> columns_of_eye(const FaceFront& front, const glm::dvec3& centre,
                                                       double radius) {
  constexpr int steps = 24;
  const double step = radius / steps;
  const double reach = 1.2 * radius;
  std::vector<std::pair<double, SeenEye>> columns;
  const auto look = [&](int first, double direction) {
    for (int k = first; k <= 2 * steps; ++k) {
      const double x = centre.x + direction * k * step;
      const auto eye = front.eye(x, centre.y - reach, centre.y + reach);
      if (!eye) return;
      columns.emplace_back(x, *eye);
    }
  };
  look(0, -1.0);
  std::reverse(columns.begin(), columns.end());
  look(1, 1.0);
  return columns;
}

}  // namespace

std::optional<SeenOpening> find_seen_opening(const FaceFront& front, const glm::dvec3& centre, double radius) {
  const auto columns = columns_of_eye(front, centre, radius);
  if (columns.empty()) return std::nullopt;
  const auto spot_at = [&](double x, const glm::dvec3& place) { return front.spot(front.column(x), place); };
  const auto corner = [&](const std::pair<double, SeenEye>& end) {
    const auto& [x, eye] = end;
    const auto upper = spot_at(x, eye.upper);
    return upper ? std::optional(SeenSpot{0.5 * (eye.upper + eye.lower), upper->vertex}) : std::nullopt;
  };
  const double first = columns.front().first;
  const double width = columns.back().first - first;
  // A ball may lie aside of the opening: the middle of the lids is not far from that of the eye.
  const double middle = std::clamp(centre.x, first + 0.4 * width, first + 0.6 * width);
  const auto& [x, seen] = *std::min_element(columns.begin(), columns.end(), [&](const auto& a, const auto& b) {
    return std::abs(a.first - middle) < std::abs(b.first - middle);
  });
  // The slit of an eye that is shut may end anywhere.
  if (seen.upper.y - seen.lower.y < least_open * width) return std::nullopt;
  const auto upper = spot_at(x, seen.upper);
  const auto lower = spot_at(x, seen.lower);
  const auto left = corner(columns.back());
  const auto right = corner(columns.front());
  if (!upper || !lower || !left || !right) return std::nullopt;
  return SeenOpening{*upper, *lower, *left, *right};
}

}  // namespace semblante
