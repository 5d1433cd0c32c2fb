#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace semblante {

/// Nearest-point queries: a balanced k-d tree over a copy of the points.
class NearestPoint {
 public:
  struct Hit {
    std::uint32_t index;  ///< into the points given; of points at equal distance the lowest
    double distance;
  };

  /// `points` must not be empty.
  explicit NearestPoint(std::span<const glm::dvec3> points);

  [[nodiscard]] Hit nearest(const glm::dvec3& to) const;
  /// Whether a point is nearer than `distance`: much faster than `nearest` where most are farther.
  [[nodiscard]] bool has_within(const glm::dvec3& to, double distance) const;
  /// Indices of the nearest point and of all that are as near but for rounding; rising. Empty if none is nearer than
  /// `within`.
  [[nodiscard]] std::vector<std::uint32_t> nearest_with_ties(
      const glm::dvec3& to, double within = std::numeric_limits<double>::infinity()) const;

 private:
  struct Node {
    glm::dvec3 position;
    std::uint32_t index;
  };
  void build(std::size_t first, std::size_t last, int axis);
  /// Calls `look` with the index and the squared distance of points, near ones first: all but those of ranges whose
  /// boxes are farther than the square `reach`, which `look` may lower. `outside`: how far `to` is outside this range's
  /// box, along each axis.
  template <class Look>
  void go_through(std::size_t first, std::size_t last, int axis, const glm::dvec3& to, const glm::dvec3& outside,
                  const double& reach, const Look& look) const;

  /// The middle of each range splits it, along x, y, z in turn, down to ranges that are quicker to go through.
  std::vector<Node> nodes_;
};

}  // namespace semblante
