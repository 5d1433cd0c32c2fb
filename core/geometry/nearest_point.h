#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace semblante {

/// Nearest-point queries: a balanced tree of boxes over a copy of the points. The ranges of the tree are split when a
/// query first enters them, because most queries are about few places: queries are for one thread at a time.
class NearestPoint {
 public:
  struct Hit {
    std::uint32_t index;  ///< into the points given; of points at equal distance the lowest
    double distance;
  };

  /// `points` must not be empty.
  explicit NearestPoint(std::span<const glm::dvec3> points);

  [[nodiscard]] Hit nearest(const glm::dvec3& to);
  /// Whether a point is nearer than `distance`: much faster than `nearest` where most are farther.
  [[nodiscard]] bool has_within(const glm::dvec3& to, double distance);
  /// Indices of the nearest point and of all that are as near but for rounding; rising. Empty if none is nearer than
  /// `within`.
  [[nodiscard]] std::vector<std::uint32_t> nearest_with_ties(const glm::dvec3& to,
                                                             double within = std::numeric_limits<double>::infinity());

 private:
  struct Node {
    glm::dvec3 position;
    std::uint32_t index;
  };
  /// A range of nodes, and the box around them.
  struct Range {
    glm::dvec3 low, high;
    bool is_split = false;
    [[nodiscard]] double squared_distance(const glm::dvec3& to) const;
  };
  [[nodiscard]] Range range_of(std::size_t first, std::size_t last) const;
  /// Brings the middle node of a range along the longest side of its box to its place, with lower ones in front of it.
  void split(std::size_t range, std::size_t first, std::size_t last);
  /// Calls `look` with the index and the squared distance of points, near ones first: all but those of ranges whose
  /// boxes are farther than the square `reach`, which `look` may lower.
  template <class Look>
  void go_through(std::size_t range, std::size_t first, std::size_t last, const glm::dvec3& to, const double& reach,
                  const Look& look);
  template <class Look>
  void go_through_all(const glm::dvec3& to, const double& reach, const Look& look);

  std::vector<Node> nodes_;
  /// Those of range r are 2 r + 1 and 2 r + 2, in front of its middle node and behind it. Ranges of few nodes are not
  /// split: it is quicker to go through them.
  std::vector<Range> ranges_;
};

}  // namespace semblante
