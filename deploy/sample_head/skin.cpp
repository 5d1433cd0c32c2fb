#include "deploy/sample_head/skin.h"

#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "deploy/sample_head/ear.h"
#include "deploy/sample_head/eyelids.h"
#include "deploy/sample_head/feature_points.h"
#include "deploy/sample_head/lips.h"
#include "deploy/sample_head/nostrils.h"
#include "deploy/sample_head/sculpt.h"
#include "deploy/sample_head/shirt.h"
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

/// Puts the border on the neckline and continues it a little, tucked under the collar.
void tuck_neckline(HalfMesh& mesh, const Loop& border) {
  const auto at = [&](int v) -> Vec3& { return mesh.positions[static_cast<std::size_t>(v)]; };
  Loop tucked;
  for (const int v : border) {
    if (at(v).x != 0.0) at(v) = neckline(std::atan2(at(v).x, at(v).z + 3.4));
    const Vec3 n = head_normal(at(v));
    Vec3 below = project_to_head(at(v) + Vec3(0.0, -0.5, 0.0) + Vec3(n.x, 0.0, n.z) * 0.5) - n * 0.25;
    if (at(v).x == 0.0) below.x = 0.0;
    tucked.push_back(mesh.add(below));
  }
  bridge(mesh, border, tucked, false, Chart::outer);
}

}  // namespace

Skin make_skin(const SampleHeadTraits& traits) {
  SkinCage cage = make_skin_cage();
  Skin skin;
  skin.mesh = subdivide(cage.mesh);
  for (auto& p : skin.mesh.positions) p = project_to_head(p);
  // Jaw and chin form the outline.
  skin.mesh =
      refine(skin.mesh, [](const Vec3& p) { return p.y > -12.5 && ((p.y < -4.6 && p.z < 6.2) || p.y < -9.55); });
  for (auto& p : skin.mesh.positions) p = project_to_head(p);
  relax(skin.mesh, 6);
  // Finds all holes before filling any: a filling must not change another hole's border.
  const Loop orbit = boundary_loop(skin.mesh, cage["E0"], {0.0, 1.0, 0.0});
  const Loop around_mouth = boundary_loop(skin.mesh, cage["M5_0"], {1.0, 0.0, 0.0});
  const Loop nostril = boundary_loop(skin.mesh, cage["h0"], {1.0, 0.0, 0.0});
  const Loop ear = boundary_loop(skin.mesh, cage["Y7"], {0.0, 1.0, 0.0});
  const Loop edge = boundary_loop(skin.mesh, cage["neckline"], {1.0, 0.0, 0.0});
  add_eyelids(skin, orbit);
  add_lips(skin, around_mouth, traits.pressed_lips);
  add_nostril(skin, nostril);
  add_ear(skin, ear);
  tuck_neckline(skin.mesh, edge);
  skin.marks["9.15"] = around_mouth[0];
  mark_skin_points(skin);
  orient(skin.mesh, {0.0, 0.0, 1.0});
  return skin;
}

}  // namespace semblante::sample_head_detail
