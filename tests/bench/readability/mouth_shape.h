#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "tests/support/closure.h"
#include "tests/support/posed_face.h"

namespace semblante::bench {

/// A mouth as phonetics describes it.
struct MouthShape {
  double opening = 0.0;     ///< the widest way up between the lips as seen from the front, teeth counted in; of MNS0
  double width = 0.0;       ///< between the inner corners 2.4 and 2.5, of the neutral width
  double protrusion = 0.0;  ///< how far 2.2, 2.3, 2.6 to 2.9 are in front of where they rest, mean, of MNS0
};

/// Measures mouths of one head.
class Mouth {
 public:
  /// Empty where lips do not open (a mask) or points are not marked.
  static std::optional<Mouth> find(const PosedFace& face);

  [[nodiscard]] MouthShape measure(std::span<const glm::vec3> moved) const;
  [[nodiscard]] Closure closure(std::span<const glm::vec3> moved) const { return opening_.measure(moved); }
  /// Column by column, from the right corner to the left.
  [[nodiscard]] std::vector<Closure> columns_of(std::span<const glm::vec3> moved) const {
    return opening_.columns_of(moved);
  }

  /// From the edge of the upper front teeth to the lower lip: the mean, over places along the middle eighth of the
  /// mouth, of the shortest way; of MNS0. A tooth that the lip takes in touches it. Empty where a head has no teeth.
  [[nodiscard]] std::optional<double> teeth_to_lower_lip(std::span<const glm::vec3> moved) const;

 private:
  explicit Mouth(Opening opening) : opening_(std::move(opening)) {}

  Opening opening_;
  std::vector<glm::vec3> rest_;
  std::vector<std::uint32_t> inner_lips_;
  std::array<std::uint32_t, 2> corners_{};
  std::vector<std::uint32_t> teeth_edge_;  ///< file vertices, one a place along the mouth
  std::vector<Triangle> lower_lip_, skin_;
  double mouth_nose_ = 1.0;
};

}  // namespace semblante::bench
