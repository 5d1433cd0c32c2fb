#pragma once

#include <span>
#include <vector>

#include "core/anatomy/point_lookup.h"
#include "core/geometry/surface.h"
#include "core/types/rig.h"

namespace semblante {

/// How much of the jaw's motion, and of the tongue's own, a vertex inside the mouth takes: 0..1.
struct MouthShare {
  double jaw = 0.0;
  double tongue = 0.0;
};

/// #S shares; zero outside the parts with a tooth's or the tongue's role.
///
/// Lower teeth and tongue take the jaw fully, upper teeth not at all. On many heads, though, both gums and the tongue
/// are one piece, joined at the throat: taken as a tongue it would pull the upper gum off its teeth. Such a part is
/// known by the teeth of both rows standing in it. Its vertices then go by the way along the surface: with the upper
/// teeth where those are nearer, with the jaw where lower teeth or tongue points are, smoothly between; and the
/// tongue's own points do not move the gums.
std::vector<MouthShare> share_of_jaw(const Surface& surface, std::span<const Part> parts,
                                     std::span<const SurfacePoint> points);

}  // namespace semblante
