#include "deploy/sample_head/skin.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "deploy/sample_head/ear.h"
#include "deploy/sample_head/eyelids.h"
#include "deploy/sample_head/feature_points.h"
#include "deploy/sample_head/lips.h"
#include "deploy/sample_head/nostrils.h"
#include "deploy/sample_head/sculpt.h"
#include "deploy/sample_head/skin_cage.h"
#include "deploy/sample_head/subdivide.h"

namespace semblante::sample_head_detail {
namespace {

/// Relaxes the mesh along the surface: every free vertex moves towards the mean of its neighbours and is then projected
/// onto the sculpt. Border loops do not move.
void relax(HalfMesh& mesh, int rounds) {
  const auto neighbours = neighbours_of(mesh);
  std::vector<int> uses(mesh.positions.size(), 0);
  for (const auto& face : mesh.faces) {
    for (const int v : face.corner) {
      if (v >= 0) ++uses[static_cast<std::size_t>(v)];
    }
  }
  for (int round = 0; round < rounds; ++round) {
    std::vector<Vec3> next = mesh.positions;
    for (std::size_t v = 0; v < next.size(); ++v) {
      // An inner vertex has as many faces as edges; a border vertex has one face fewer.
      const bool mirror = mesh.on_mirror(static_cast<int>(v));
      const int edges = static_cast<int>(neighbours[v].size());
      if (uses[v] < (mirror ? edges - 1 : edges)) continue;
      Vec3 sum(0.0);
      double weight = 0.0;
      for (const int n : neighbours[v]) {
        const Vec3 p = mesh.positions[static_cast<std::size_t>(n)];
        const double w = mirror && !mesh.on_mirror(n) ? 2.0 : 1.0;
        sum += (mirror ? Vec3(0.0, p.y, p.z) : p) * w;
        weight += w;
      }
      // The nose is not relaxed: its cage follows the crease of the wing.
      const Vec3 p = mesh.positions[v];
      const double near_nose = glm::smoothstep(1.9, 0.9, glm::length(p - Vec3(0.7, -3.9, 10.0)));
      next[v] = p + (sum / weight - p) * (0.5 * (1.0 - near_nose));
    }
    for (std::size_t v = 0; v < next.size(); ++v) mesh.positions[v] = project_to_head(next[v]);
  }
}

/// The edge of the bust: horizontal, and rolled in under the neck.
void finish_bust(HalfMesh& mesh, const Loop& border) {
  constexpr double level = -15.5;
  const auto at = [&](int v) -> Vec3& { return mesh.positions[static_cast<std::size_t>(v)]; };
  for (const int v : border) {
    const Vec3 outward(at(v).x, 0.0, at(v).z + 1.8);
    at(v) = cast_from_inside({0.0, level, -1.8}, outward);
    if (outward.x == 0.0) at(v).x = 0.0;
  }
  Loop outer = border;
  struct Step {
    double size, down;
  };
  for (const auto& step : {Step{0.985, 0.16}, Step{0.94, 0.24}, Step{0.86, 0.26}}) {
    Loop loop;
    for (const int v : border) {
      const Vec3 p = at(v);
      loop.push_back(mesh.add({p.x * step.size, p.y - step.down, (p.z + 1.8) * step.size - 1.8}));
    }
    bridge(mesh, outer, loop, false, Chart::outer);
    outer = loop;
  }
}

}  // namespace

Skin make_skin() {
  SkinCage cage = make_skin_cage();
  Skin skin;
  skin.mesh = subdivide(cage.mesh);
  for (auto& p : skin.mesh.positions) p = project_to_head(p);
  // Jaw and neck form the outline and have no moving point, so more vertices there do no harm.
  skin.mesh = refine(skin.mesh, [](const Vec3& p) { return p.y < -4.6 && p.z < 5.2; });
  for (auto& p : skin.mesh.positions) p = project_to_head(p);
  relax(skin.mesh, 6);
  // Finds all holes before filling any: a filling must not change another hole's border.
  const Loop orbit = boundary_loop(skin.mesh, cage["E0"], {0.0, 1.0, 0.0});
  const Loop around_mouth = boundary_loop(skin.mesh, cage["M5_0"], {1.0, 0.0, 0.0});
  const Loop nostril = boundary_loop(skin.mesh, cage["h0"], {1.0, 0.0, 0.0});
  const Loop ear = boundary_loop(skin.mesh, cage["Y7"], {0.0, 1.0, 0.0});
  const Loop bust = boundary_loop(skin.mesh, cage["bust"], {1.0, 0.0, 0.0});
  add_eyelids(skin, orbit);
  add_lips(skin, around_mouth);
  add_nostril(skin, nostril);
  add_ear(skin, ear);
  finish_bust(skin.mesh, bust);
  skin.marks["9.15"] = around_mouth[0];
  mark_skin_points(skin);
  orient(skin.mesh, {0.0, 0.0, 1.0});
  return skin;
}

}  // namespace semblante::sample_head_detail
