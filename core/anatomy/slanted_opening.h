#pragma once

#include <algorithm>

#include <glm/vec3.hpp>

#include "core/anatomy/lid_edge.h"

namespace semblante {

/// Up to this share more than the difference of the points' heights the eye is not slanted. Faces have 0.98 to 1.045.
inline constexpr double not_slanted = 1.05;
/// At most; the height of an eye that is turned by 35 degrees. Beyond it the points are not those of lids.
inline constexpr double most_slanted = 1.5;

/// The height of an eye's opening at one x, model units, from the middles of its lids and the corners: lids close
/// straight downwards. Of most eyes the difference of the middles' heights. Those of a slanted eye lie beside each
/// other, so that the lower one is not below the upper one but on a line that rises as the corners do.
inline double opening_height(const glm::dvec3& upper, const glm::dvec3& lower, const glm::dvec3& corner,
                             const glm::dvec3& other_corner) {
  const double apart = upper.y - lower.y;
  const double width = other_corner.x - corner.x;
  if (!(apart > 0.0) || width == 0.0) return apart;
  const double at_one_x = apart - (other_corner.y - corner.y) / width * (upper.x - lower.x);
  return at_one_x > not_slanted * apart ? std::min(at_one_x, most_slanted * apart) : apart;
}

inline double opening_height(const LidEdge& upper, const LidEdge& lower) {
  return opening_height(upper.middle.position, lower.middle.position, upper.corners[0].position,
                        upper.corners[1].position);
}

}  // namespace semblante
