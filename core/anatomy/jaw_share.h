#pragma once

#include <span>
#include <vector>

#include "core/anatomy/point_lookup.h"
#include "core/geometry/surface.h"
#include "core/types/rig.h"

namespace semblante {

/// The shares of the jaw's motion and of the tongue's own motion at a vertex inside the mouth: 0..1.
struct MouthShare {
  double jaw = 0.0;
  double tongue = 0.0;
};

/// #S shares; zero outside the parts with a tooth's or the tongue's role.
///
/// Lower teeth and tongue follow the jaw fully, upper teeth not at all. On many heads, though, both gums and the tongue
/// are one part, joined at the throat. If all of it moved as the tongue does, it would pull the upper gum off its
/// teeth. Such a part is recognized by both rows of teeth in it. The shares of its vertices depend on distances along
/// the surface: they follow the upper teeth where those are nearer, the jaw where lower teeth or tongue points are
/// nearer, with a smooth transition; and the tongue's own points do not move the gums. The same for teeth that are one
/// part with both rows, told by its height and the lips at its middle.
std::vector<MouthShare> share_of_jaw(const Surface& surface, std::span<const Part> parts,
                                     std::span<const SurfacePoint> points);

}  // namespace semblante
