#pragma once

#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "tests/support/posed_face.h"

namespace semblante::bench {

/// What a face says, read off its skin alone: every combination of a viseme and an expression against the visemes
/// and the expressions by themselves. Of two faces the distance in a region is the root mean square, over the area of
/// that region's skin at rest, of how far apart the two put a place; of ES0.
class FaceReading {
 public:
  static constexpr std::size_t visemes = 15;
  static constexpr std::size_t expressions = 7;

  /// Where one looks for speech: skin led by the points of lips, jaw and chin (2.x, 8.x), at least by half. Where one
  /// looks for an expression while somebody speaks: skin led by those of eyes, brows, cheek bones and nose (3.x, 4.x,
  /// 5.3, 5.4, 9.x).
  enum class Region { mouth, upper_face };

  /// Poses all 105 faces.
  explicit FaceReading(const PosedFace& face);

  [[nodiscard]] std::span<const glm::vec3> pose(std::size_t viseme, std::size_t expression) const {
    return poses_[viseme * expressions + expression];
  }
  [[nodiscard]] double distance(std::span<const glm::vec3> a, std::span<const glm::vec3> b, Region region) const;
  /// Over both regions.
  [[nodiscard]] double distance(std::span<const glm::vec3> a, std::span<const glm::vec3> b) const;

  struct Nearest {
    std::size_t entry;
    double distance;
    double second;  ///< of the next but one: how sure the reading is
  };
  /// Of the visemes but `sil`, by themselves, the nearest to a face, by the mouth.
  [[nodiscard]] Nearest read_viseme(std::size_t viseme, std::size_t expression) const;
  /// Of the expressions and `none`, by themselves, the nearest to a face, by the upper face.
  [[nodiscard]] Nearest read_expression(std::size_t viseme, std::size_t expression) const;

 private:
  std::vector<std::vector<glm::vec3>> poses_;
  std::vector<double> area_;  ///< #V of the file: a third of the triangles around, at rest
  std::vector<std::uint32_t> mouth_, upper_face_;
  double eye_separation_ = 1.0;
};

}  // namespace semblante::bench
