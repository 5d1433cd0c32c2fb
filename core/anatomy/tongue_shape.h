#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/anatomy/jaw_share.h"
#include "core/anatomy/point_lookup.h"
#include "core/geometry/surface.h"
#include "core/types/moving_parts.h"
#include "core/types/rig.h"

namespace semblante {

/// The tongue that FAP 47 rolls.
struct TongueOfHead {
  Tongue shape;
  std::vector<double> share;  ///< #S: how much of the roll a vertex takes, 0..1
};

/// Finds the tongue: the parts with that role, or the tongue's portion of a part joined with the gums. Its width is
/// that of its border points 6.3 and 6.4 if they are marked. From those points to the tip it rolls fully; behind them,
/// towards its root, decreasingly. nullopt without a tongue, or if it has no width. `mouth`: share_of_jaw.
std::optional<TongueOfHead> find_tongue(const Surface& surface, std::span<const Part> parts,
                                        std::span<const SurfacePoint> points, std::span<const MouthShare> mouth);

}  // namespace semblante
