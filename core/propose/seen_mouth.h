#pragma once

#include <optional>

#include "core/propose/face_front.h"

namespace semblante {

/// The edges of the lips at one x.
struct SeenLips {
  SeenSpot upper, lower;
  [[nodiscard]] glm::dvec3 middle() const { return 0.5 * (upper.place + lower.place); }
};

struct SeenMouth {
  SeenLips middle, left, right;
  [[nodiscard]] double width() const { return left.middle().x - right.middle().x; }
};

/// The mouth that is seen below the eyes: where skin is seen right below other skin from which the way through the
/// mouth is long. Lips that are joined have none. Of several such slits, the widest.
std::optional<SeenMouth> find_seen_mouth(const FaceFront& front);

}  // namespace semblante
