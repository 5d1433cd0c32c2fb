#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/anatomy/point_lookup.h"
#include "core/geometry/surface.h"
#include "core/types/moving_parts.h"
#include "core/types/rig.h"

namespace semblante {

/// What FAP 47 rolls.
struct TongueOfHead {
  Tongue shape;
  std::vector<double> share;  ///< #S: how much of the roll a vertex takes, 0..1
};

/// The tongue: the parts with that role, of one in a piece with the gums what is tongue of it. Its width is that of its
/// border points 6.3 and 6.4 where they are marked. From those points to the tip it rolls as a whole; behind them,
/// where a tongue is held by its root, less and less. Nothing where there is no tongue, or none with a breadth.
std::optional<TongueOfHead> find_tongue(const Surface& surface, std::span<const Part> parts,
                                        std::span<const SurfacePoint> points);

}  // namespace semblante
