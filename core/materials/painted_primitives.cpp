#include "core/materials/painted_primitives.h"

#include <utility>

namespace semblante {

std::vector<Primitive> painted_primitives(const Model& model, const PaintOf& paint_of) {
  std::vector<Primitive> runs;
  for (const Primitive& primitive : model.primitives) {
    const std::uint32_t end = primitive.first_triangle + primitive.triangle_count;
    for (std::uint32_t t = primitive.first_triangle; t < end;) {
      Primitive run = primitive;
      run.first_triangle = t;
      const std::optional<int> paint = paint_of(primitive, t);
      while (t < end && paint_of(primitive, t) == paint) ++t;
      run.triangle_count = t - run.first_triangle;
      run.material = paint ? *paint : run.material;
      runs.push_back(std::move(run));
    }
    if (primitive.triangle_count == 0) runs.push_back(primitive);
  }
  return runs;
}

}  // namespace semblante
