#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "core/anatomy/point_lookup.h"
#include "core/geometry/surface.h"
#include "core/types/example.h"
#include "core/types/model.h"

namespace semblante {

/// The shapes of a head that weights can be fitted to.
struct OwnShapes {
  std::vector<Example> shapes;       ///< `vertices` are surface vertices
  std::vector<std::string> ignored;  ///< names of the other shapes of the model
};

/// A bound of memory and time; further shapes are ignored.
inline constexpr std::size_t max_own_shapes = 512;

/// Shapes that move some of the points and leave at least a tenth of them at rest: one that moves all is another person
/// or a turn of the head, not an expression.
OwnShapes own_shapes(const Model& model, const Surface& surface, std::span<const SurfacePoint> points);

/// The same shapes by member of a part: `vertices` are places in `members`.
std::vector<Example> shapes_of_members(std::span<const Example> shapes, std::span<const SurfaceVertexId> members);

}  // namespace semblante
