#pragma once

#include <optional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "tests/support/posed_face.h"

namespace semblante::bench {

enum class OpeningKind { mouth, left_eye, right_eye };

/// How far an opening of the face is shut, as shares of its unit (MNS0 for the mouth, IRISD0 for an eye): the worst of
/// the columns between its corners, where a column is the section of the face with a plane of equal x.
struct Closure {
  /// Seen straight from the front: the longest way up a column that shows what lies behind the lips or lids.
  double slit = 0.0;
  /// Where the surfaces of both cross: how far one reaches into the other, along y.
  double crossing = 0.0;
  std::size_t crossing_columns = 0;
  /// Seen likewise: the longest way up a column that shows the inside above the edge of the upper or below that of the
  /// lower, where a lip or lid should cover it.
  double pierced = 0.0;
};

/// Upper and lower lip or lid of a head: the vertices nearer to the points of the one than to those of the other.
class Opening {
 public:
  /// Empty where points or parts are missing (a mask without eyeballs has no eye to close).
  static std::optional<Opening> find(const PosedFace& face, OpeningKind kind);

  /// The worst column, and the sum of those that cross.
  [[nodiscard]] Closure measure(std::span<const glm::vec3> moved) const;
  /// Column by column, from the right corner to the left.
  [[nodiscard]] std::vector<Closure> columns_of(std::span<const glm::vec3> moved) const;

 private:
  enum class Side : std::uint8_t { neither, upper, lower };
  struct Piece {
    Triangle triangle;
    Side side;
    bool inside;  ///< eyeball, tooth or tongue
  };
  std::vector<Piece> pieces_;
  double from_x_ = 0.0, to_x_ = 0.0;
  double unit_ = 1.0;
};

/// With the six points of the lower lip moved down alike: the greatest motion of a vertex of the upper lip, as share of
/// theirs. Of the upper lip are vertices within 0.14 ES0 of a point of it along the surface, and at most half as far
/// from that as from any point of the lower lip. None where the points do not give the units.
std::optional<double> leak_to_upper_lip(const PosedFace& face);

}  // namespace semblante::bench
