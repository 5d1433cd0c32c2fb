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
  void search(std::size_t first, std::size_t last, int axis, const glm::dvec3& to, std::uint32_t& index,
              double& squared) const;
  /// The square of the distance to the nearest point, or `bound` if it is not less.
  [[nodiscard]] double square_within(const glm::dvec3& to, double bound) const;
  void collect(std::size_t first, std::size_t last, int axis, const glm::dvec3& to, double squared,
               std::vector<std::uint32_t>& indices) const;

  /// The middle of each range splits it, along x, y, z in turn, down to ranges that are quicker to go through.
  std::vector<Node> nodes_;
};

}  // namespace semblante
