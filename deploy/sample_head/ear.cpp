#include "deploy/sample_head/ear.h"

#include <cmath>
#include <iterator>
#include <numbers>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace semblante::sample_head_detail {
namespace {

using std::numbers::pi;

/// The ear's own frame: `up` along its length, `back` across it, `out` away from the head. The ear is tilted back by
/// about 12 degrees and away from the head by about 12.
struct Frame {
  Vec3 origin, up, back, out;
  [[nodiscard]] Vec3 at(double u, double b, double o) const { return origin + up * u + back * b + out * o; }
};

Frame ear_frame() {
  Frame f;
  f.origin = {6.8, -1.25, -0.65};
  f.up = glm::normalize(Vec3(0.17, 1.0, -0.20));
  const Vec3 back = glm::normalize(Vec3(0.16, 0.0, -1.0));
  f.out = glm::normalize(glm::cross(back, f.up));
  if (f.out.x < 0.0) f.out = -f.out;
  f.back = glm::normalize(back - f.up * glm::dot(back, f.up));
  return f;
}

/// sign(v) |v|^e: e < 1 makes a circle squarer, so that top and lobe are round instead of pointed.
double rounded(double v, double e) { return std::copysign(std::pow(std::abs(v), e), v); }

/// Outline of the ear at angle a: 0 front, pi/2 top, pi back, 3 pi/2 the lobe. Egg-shaped, broad above, narrow below.
Vec2 outline(double a) {
  const double up = std::sin(a);
  const double back = -std::cos(a);
  const double length = up > 0.0 ? 2.9 : 2.95;
  double width = back > 0.0 ? 2.05 : 1.25;
  width *= 1.0 - 0.16 * glm::smoothstep(0.2, -0.9, up);
  return {length * rounded(up, 0.94), width * rounded(back, up < 0.0 ? 0.72 : 0.85) + 0.15 * up};
}

/// A ring of the ear: outline scaled by `size` about a centre that shifts by (up, back), at height `out` (cm). `front`
/// is the height at the front, where helix and tragus join the cheek; `lobe_size` and `lobe` are size and height at the
/// lobe, a soft round pad whose foot joins the cheek nearly at its outline.
struct EarRing {
  double size, up, back, out, front, lobe_size, lobe;
};

constexpr EarRing ring_table[] = {
    {0.70, 0.0, 0.00, 0.20, 0.12, 0.86, 0.02},     // foot, behind
    {0.78, 0.0, 0.05, 0.62, 0.20, 0.95, 0.26},     // back of the shell
    {0.94, 0.0, 0.02, 0.98, 0.28, 0.99, 0.46},     // behind the rim
    {1.00, 0.0, 0.00, 1.20, 0.36, 1.00, 0.66},     // outermost edge of the helix
    {0.975, 0.0, 0.00, 1.36, 0.44, 0.97, 0.84},    // top of the helix
    {0.90, 0.0, 0.00, 1.36, 0.46, 0.90, 0.96},     // its inner edge
    {0.84, 0.0, 0.00, 1.12, 0.36, 0.84, 1.00},     // groove
    {0.76, 0.0, 0.00, 1.06, 0.34, 0.76, 1.02},     // floor of the groove
    {0.66, 0.0, 0.02, 1.24, 0.44, 0.66, 1.03},     // rise to the antihelix
    {0.58, -0.02, 0.02, 1.27, 0.50, 0.58, 1.06},   // antihelix
    {0.48, -0.12, 0.00, 1.08, 0.52, 0.48, 1.02},   // rim of the bowl
    {0.40, -0.18, -0.04, 0.60, 0.46, 0.40, 0.60},  // wall of the bowl
    {0.30, -0.20, -0.10, 0.30, 0.30, 0.30, 0.30},  // floor of the bowl
    {0.14, -0.20, -0.20, 0.15, 0.12, 0.14, 0.15},
};

/// The vertex of the back edge nearest to the height half way between top and lobe, moved to exactly that height.
int back_of_ear(HalfMesh& mesh, const Loop& edge, int top, int lobe) {
  const auto at = [&](int v) -> Vec3& { return mesh.positions[static_cast<std::size_t>(v)]; };
  const double height = 0.5 * (at(top).y + at(lobe).y);
  int best = -1;
  for (const int v : edge) {
    if (at(v).z > at(top).z - 0.3) continue;
    if (best < 0 || std::abs(at(v).y - height) < std::abs(at(best).y - height)) best = v;
  }
  at(best).y = height;
  return best;
}

}  // namespace

void add_ear(Skin& skin, const Loop& hole) {
  HalfMesh& mesh = skin.mesh;
  const Frame frame = ear_frame();
  const std::size_t count = 2 * hole.size();  // the outline of the ear needs more vertices than its hole in the cheek
  Loop outer = hole;
  Loop edge;
  std::size_t index = 0;
  for (const EarRing& ring : ring_table) {
    Loop loop;
    for (std::size_t k = 0; k < count; ++k) {
      const double a = 2.0 * pi * static_cast<double>(k) / static_cast<double>(count);
      const Vec2 o = outline(a);
      const double up = std::sin(a);
      const double to_front = glm::smoothstep(0.35, 0.95, std::cos(a));
      const double lobe = glm::smoothstep(-0.35, -0.9, up);
      const double out = 0.74 * glm::mix(glm::mix(ring.out, ring.front, to_front), ring.lobe, lobe);  // near the head
      const double size = glm::mix(ring.size, ring.lobe_size, lobe);
      Paint paint;
      paint.flush = 0.6;
      loop.push_back(mesh.add(frame.at(o.x * size + ring.up, o.y * size + ring.back, out), paint));
    }
    if (index == 0) {
      bridge_doubling(mesh, outer, loop, Chart::outer);
    } else {
      bridge(mesh, outer, loop, true, Chart::outer);
    }
    outer = loop;
    if (index == 3) edge = loop;
    ++index;
  }
  Paint paint;
  paint.flush = 0.6;
  close_with_fan(mesh, outer, true, mesh.add(frame.at(-0.2, -0.25, 0.07), paint), Chart::outer);

  const auto extreme = [&](const Loop& loop, const Vec3& direction) {
    int best = loop[0];
    for (const int v : loop) {
      const auto along = [&](int i) { return glm::dot(mesh.positions[static_cast<std::size_t>(i)], direction); };
      if (along(v) > along(best)) best = v;
    }
    return best;
  };
  skin.marks["10.1"] = extreme(edge, {0.0, 1.0, 0.0});
  skin.marks["10.5"] = extreme(edge, {0.0, -1.0, 0.0});
  skin.marks["10.3"] = back_of_ear(mesh, edge, skin.marks["10.1"], skin.marks["10.5"]);
  skin.marks["10.9"] = extreme(hole, {0.0, 0.6, 1.0});
  skin.marks["10.7"] = extreme(hole, {0.0, -0.6, 1.0});
}

}  // namespace semblante::sample_head_detail
