#include "deploy/sample_head/nostrils.h"

#include <glm/common.hpp>

namespace semblante::sample_head_detail {

void add_nostril(Skin& skin, const Loop& rim) {
  HalfMesh& mesh = skin.mesh;
  Vec3 centre(0.0);
  for (const int v : rim) centre += mesh.positions[static_cast<std::size_t>(v)] / static_cast<double>(rim.size());
  Loop outer = rim;
  struct Step {
    double size, up;
  };
  constexpr Step steps[] = {{0.94, 0.10}, {0.85, 0.25}, {0.7, 0.5}, {0.35, 0.7}};
  double depth = 0.0;
  Chart chart = Chart::outer;
  for (const auto& step : steps) {
    Loop loop;
    Paint paint;
    paint.inner_uv = {depth, 2.0};
    for (const int v : rim) {
      const Vec3 p = mesh.positions[static_cast<std::size_t>(v)];
      loop.push_back(mesh.add(glm::mix(centre, p, step.size) + Vec3(0.05, 0.9, -0.25) * step.up, paint));
    }
    bridge(mesh, outer, loop, true, chart);
    outer = loop;
    chart = Chart::inner;
    depth += 0.3;
  }
  Paint deep;
  deep.inner_uv = {1.0, 2.0};
  close_with_fan(mesh, outer, true, mesh.add(centre + Vec3(0.04, 0.7, -0.2), deep), Chart::inner);
}

}  // namespace semblante::sample_head_detail
