#pragma once

#include <cstddef>
#include <span>

#include <glm/vec3.hpp>

#include "core/types/model.h"

namespace semblante::bench {

/// Triangles of a moved face against the same at rest; no part of the face may have been turned as a whole.
struct FoldOver {
  std::size_t inverted = 0;    ///< normal turned by more than 90 degrees
  std::size_t degenerate = 0;  ///< neither: at rest or moved, a sliver without a normal to speak of
  double inverted_area = 0.0;  ///< of the inverted ones, moved
  FoldOver& operator+=(const FoldOver& other);
};

FoldOver count_fold_over(std::span<const Triangle> triangles, std::span<const glm::vec3> rest,
                         std::span<const glm::vec3> moved);

}  // namespace semblante::bench
