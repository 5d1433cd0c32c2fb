#pragma once

#include <cstdint>
#include <span>

#include <glm/vec3.hpp>

#include "core/geometry/surface.h"
#include "core/types/model.h"

namespace semblante {

/// Changes the shares of the head's rotation (turn_with_head()) where the skin of the neck would turn over when the
/// head turns by 0.6 rad about an axis: on a short or a thick neck the chin comes down where the throat is. The shares
/// there approach those around them until no triangle turns over, or as far as that helps. Shares of 0 and 255 stay,
/// and so do all shares of a neck without such triangles. `triangles` are those of the model.
void unfold_neck(const Surface& surface, std::span<const Triangle> triangles, const glm::vec3& head_pivot,
                 std::span<std::uint8_t> turn);

}  // namespace semblante
