#include "deploy/sample_head/lips.h"

#include <cmath>
#include <numbers>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "deploy/sample_head/sculpt.h"

namespace semblante::sample_head_detail {
namespace {

using std::numbers::pi;

constexpr double mouth_y = -6.72;
constexpr double corner_x = 2.52;        ///< of the border of the red, 8.3
constexpr double inner_corner_x = 2.38;  ///< of the line where the lips meet, 2.4
constexpr double gap = 0.012;            ///< between the lips: invisible, but keeps the surfaces separate
constexpr double pressed_gap = 0.004;

struct LipPlace {
  double along;  ///< 0 middle .. 1 corner
  bool upper;
};

/// Steps are a little wider beside the feature points, at 0, 1/2 and 1, than between them, so that a point that moves
/// alone makes a slope instead of a spike. With much wider ones the lower lip of an open mouth is pointed in the
/// middle.
double spread(double along) {
  const double half = along < 0.5 ? 0.0 : 0.5;
  const double t = 4.0 * (along - half) - 1.0;  // -1 .. 1 from one point to the next
  return half + 0.25 + 0.25 * t * glm::mix(1.0, std::abs(t), 0.25);
}

LipPlace lip_place(int k) {
  const bool upper = k <= lip_steps / 2;
  return {spread(static_cast<double>(upper ? k : lip_steps - k) / (0.5 * lip_steps)), upper};
}

/// The corners are a little higher than the middle: a mouth that is level in the mesh looks sad under light from above.
double corner_rise(double s) { return 0.25 * std::pow(s, 2.4); }

/// Border of the red (8.x): cupid's bow above, a full curve below.
Vec2 border(const LipPlace& place) {
  const double s = place.along;
  const double x = corner_x * s;
  if (place.upper) {
    const double fall = 0.70 * (1.0 - std::pow(s, 1.9));
    const double bow = -0.08 * std::exp(-std::pow(s / 0.12, 2.0));
    return {x, mouth_y + fall + bow + corner_rise(s)};
  }
  return {x, mouth_y - 0.88 * std::pow(1.0 - std::pow(s, 2.9), 0.95) + corner_rise(s)};
}

/// Line where the lips meet (2.x), the same for both: a small tubercle in the middle, level corners.
Vec3 meeting(double s) {
  const double x = inner_corner_x * s;
  const double y = mouth_y - 0.06 * std::exp(-std::pow(s / 0.22, 2.0)) + corner_rise(s);
  const double z = front_z(x, mouth_y) - 0.16 - 0.16 * s * s;
  return {x, y, z};
}

/// Point of the red between border (0) and meeting line (1).
Vec3 red(const LipPlace& place, double t, bool pressed) {
  Vec2 b = border(place);
  if (pressed) b.y = glm::mix(b.y, meeting(place.along).y, 0.4);
  const Vec3 from(b.x, b.y, front_z(b.x, b.y) + 0.03 * (1.0 - place.along));
  const Vec3 to = meeting(place.along);
  const double taper = 1.0 - std::pow(place.along, 2.4);
  const double fullness = (place.upper ? 0.30 : 0.42) * taper * (pressed ? 0.5 : 1.0);
  const double rise = std::sin(0.5 * pi * t);
  Vec3 p;
  p.x = glm::mix(from.x, to.x, t);
  p.y = glm::mix(from.y, to.y, rise);
  p.z = glm::mix(from.z, to.z, t * t * t) + fullness * std::sin(pi * std::pow(t, 0.85));
  p.y += (place.upper ? 0.5 : -0.5) * (pressed ? pressed_gap : gap) * (1.0 - std::pow(place.along, 8.0)) * t;
  return p;
}

/// A cross-section of the mouth bag: an ellipse of half width x, from `up` above to `down` below the mouth line, at
/// depth z in the middle and z - bend at its sides.
struct BagSection {
  double x, up, down, z, bend;
};

// The first sections widen quickly behind the lips, so that the teeth are inside the bag.
constexpr BagSection bag[] = {
    {2.42, 0.06, 0.06, 9.42, 1.45}, {2.50, 0.55, 0.55, 9.18, 1.55}, {2.66, 1.35, 1.35, 9.12, 1.7},
    {2.85, 1.95, 1.95, 8.85, 1.8},  {2.95, 2.25, 2.2, 7.9, 1.4},    {2.95, 2.3, 2.2, 6.6, 0.7},
    {2.7, 2.1, 2.1, 5.2, 0.4},      {1.6, 1.3, 1.4, 4.0, 0.2},
};

}  // namespace

void add_lips(Skin& skin, const Loop& around, bool pressed) {
  HalfMesh& mesh = skin.mesh;
  const auto around_at = [&](int k) {
    return mesh.positions[static_cast<std::size_t>(around[static_cast<std::size_t>(k)])];
  };
  const auto add = [&](int k, Vec3 p, const Paint& paint) {
    if (k == 0 || k == lip_steps) p.x = 0.0;
    return mesh.add(p, paint);
  };
  Loop outer = around;
  const auto add_ring = [&](auto&& position, const Paint& paint, Chart chart) {
    Loop loop;
    for (int k = 0; k <= lip_steps; ++k) loop.push_back(add(k, position(k), paint));
    bridge(mesh, outer, loop, false, chart);
    outer = loop;
    return loop;
  };

  for (const double t : {0.42, 0.76}) {
    add_ring(
        [&](int k) {
          const Vec2 b = border(lip_place(k));
          const Vec3 from = around_at(k);
          const double x = glm::mix(from.x, b.x, t);
          const double y = glm::mix(from.y, b.y, t);
          return Vec3(x, y, front_z(x, y));
        },
        {}, Chart::outer);
  }

  Paint paint;
  const auto red_ring = [&](double t) {
    return add_ring([&](int k) { return red(lip_place(k), t, pressed); }, paint, Chart::outer);
  };
  paint.lip = 0.55;
  const Loop border_loop = red_ring(0.0);
  paint.lip = 1.0;
  for (const double t : {0.2, 0.45, 0.75}) red_ring(t);
  const Loop meeting_loop = red_ring(1.0);

  double depth = 0.0;
  Chart chart = Chart::outer;
  for (const auto& section : bag) {
    paint.inner_uv = {depth, 0.0};
    add_ring(
        [&](int k) {
          const LipPlace place = lip_place(k);
          const double a = 0.5 * pi * place.along;
          const double up = place.upper ? section.up : -section.down;
          return Vec3(section.x * std::sin(a), mouth_y + up * std::cos(a),
                      section.z - section.bend * std::pow(std::sin(a), 2.0));
        },
        paint, chart);
    chart = Chart::inner;
    depth += 1.0 / (std::size(bag));
  }
  paint.inner_uv = {1.0, 0.0};
  close_with_fan(mesh, outer, false, mesh.add({0.0, mouth_y, 3.7}, paint), Chart::inner);

  constexpr std::size_t corner = lip_steps / 2;
  const auto nearest_x = [&](const Loop& loop, std::size_t from, std::size_t to, double x) {
    std::size_t best = from;
    for (std::size_t k = from; k <= to; ++k) {
      const auto off = [&](std::size_t i) { return std::abs(mesh.positions[static_cast<std::size_t>(loop[i])].x - x); };
      if (off(k) < off(best)) best = k;
    }
    return loop[best];
  };
  skin.marks["2.2"] = meeting_loop[0];
  skin.marks["2.3"] = meeting_loop[lip_steps];
  skin.marks["2.4"] = meeting_loop[corner];
  skin.marks["2.6"] = meeting_loop[corner / 2];
  skin.marks["2.8"] = meeting_loop[corner + corner / 2];
  skin.marks["8.1"] = border_loop[0];
  skin.marks["8.2"] = border_loop[lip_steps];
  skin.marks["8.3"] = border_loop[corner];
  skin.marks["8.5"] = border_loop[corner / 2];
  skin.marks["8.7"] = border_loop[corner + corner / 2];
  skin.marks["8.10"] = nearest_x(border_loop, 1, corner / 2, 0.45);
}

}  // namespace semblante::sample_head_detail
