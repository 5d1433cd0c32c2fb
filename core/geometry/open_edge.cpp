#include "core/geometry/open_edge.h"

#include <algorithm>

namespace semblante {

bool is_open_edge(const Surface& surface, SurfaceVertexId a, SurfaceVertexId b) {
  const auto at_a = surface.steps_from(a);
  const auto at_b = surface.steps_from(b);
  const auto common = std::count_if(at_a.begin(), at_a.end(), [&](const Surface::Step& from_a) {
    return std::any_of(at_b.begin(), at_b.end(), [&](const Surface::Step& from_b) { return from_a.to == from_b.to; });
  });
  return common < 2;
}

}  // namespace semblante
