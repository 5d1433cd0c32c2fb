#include "core/sample_head/eyelids.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/sample_head/sculpt.h"

namespace semblante::sample_head_detail {
namespace {

constexpr double pi = 3.14159265358979323846;

// The opening, relative to the centre of the eye, in cm.
constexpr double half_width = 1.52;
constexpr double inner_corner_y = -0.10;
constexpr double outer_corner_y = 0.08;
constexpr double inner_corner_z = 0.78;  ///< the inner corner leaves the ball towards the nose
constexpr double outer_corner_z = 0.50;

/// Height of the lid edges over the line of the corners at the middle: tangent to the iris on both sides.
constexpr double lid_height = iris_radius;

struct LidPlace {
  double along;  ///< 0 inner corner .. 1 outer corner
  bool upper;
};

LidPlace place_of(int k) {
  const bool upper = k <= lid_steps / 2;
  const double along = static_cast<double>(upper ? k : lid_steps - k) / (lid_steps / 2);
  return {along, upper};
}

/// A ring of the lids: how far out it lies between the edge (0) and the orbit (1), and how much it sinks (cm) at the
/// middle of upper and lower lid.
struct Ring {
  double upper, lower;
  double upper_sink, lower_sink;
};

// From the orbit inwards. The upper crease lies at 0.30, the lower fold at 0.42.
constexpr Ring rings[] = {
    {0.84, 0.86, 0.0, 0.0},  {0.68, 0.71, 0.0, 0.0},   {0.53, 0.57, -0.02, 0.0}, {0.43, 0.47, -0.05, 0.01},
    {0.36, 0.38, 0.0, 0.02}, {0.31, 0.30, 0.05, 0.01}, {0.25, 0.23, 0.02, 0.0},  {0.17, 0.15, 0.0, 0.0},
    {0.09, 0.08, 0.0, 0.0},  {0.03, 0.025, 0.0, 0.0},
};
constexpr std::size_t crease_ring = 5;
constexpr std::size_t fold_ring = 4;

/// z of the skin in front of the eye; near the corners, where the ball falls away, the corners' own depth.
double lid_z(const Vec3& xy) { return front_z(xy.x, xy.y); }

}  // namespace

Vec3 lid_edge(int k) {
  const LidPlace place = place_of(k);
  const double from_middle = std::abs(2.0 * place.along - 1.0);
  const double x = (2.0 * place.along - 1.0) * half_width;
  const double line = glm::mix(inner_corner_y, outer_corner_y, place.along);
  // The sum of both heights stays under what a lid that turns about its corners can cover (algorithm.md section 5:
  // influence of the lid's feature point falls towards the corners), so that a blink closes the whole slit.
  const double upper = 1.0 - std::pow(from_middle, 1.75);
  const double lower = 1.0 - std::pow(from_middle, 1.7);
  const double middle_line = glm::mix(inner_corner_y, outer_corner_y, 0.5);
  const double y = place.upper ? line + (lid_height - middle_line) * upper : line - (lid_height + middle_line) * lower;
  const double r = eye_radius + 0.14;
  const double on_ball = std::sqrt(std::max(r * r - x * x - y * y, 0.0));
  const double corner = glm::mix(inner_corner_z, outer_corner_z, place.along);
  const double t = glm::smoothstep(0.62, 1.0, from_middle);
  return eye_centre + Vec3(x, y, glm::mix(on_ball, corner, t));
}

void add_eyelids(Skin& skin, const Loop& orbit) {
  HalfMesh& mesh = skin.mesh;
  const auto orbit_at = [&](int k) {
    return mesh.positions[static_cast<std::size_t>(orbit[static_cast<std::size_t>(k)])];
  };

  Loop outer = orbit;
  std::vector<Loop> loops;
  for (const Ring& ring : rings) {
    Loop loop;
    for (int k = 0; k < lid_steps; ++k) {
      const LidPlace place = place_of(k);
      const Vec3 edge = lid_edge(k);
      const double middle = std::sin(pi * place.along);  // 1 at the middle of the lid, 0 at the corners
      const double side = place.upper ? ring.upper : ring.lower;
      const double out = glm::mix(0.5 * (ring.upper + ring.lower), side, middle);
      Vec3 p = glm::mix(edge, orbit_at(k), out);
      const double z = lid_z(p) - middle * (place.upper ? ring.upper_sink : ring.lower_sink);
      p.z = glm::mix(glm::mix(p.z, z, middle), z, glm::smoothstep(0.05, 0.6, out));
      loop.push_back(mesh.add(p));
    }
    bridge(mesh, outer, loop, true, Chart::outer);
    outer = loop;
    loops.push_back(loop);
  }

  // Edge: front rim, then the rim that rests on the ball.
  Loop rim;
  Loop rest;
  for (int k = 0; k < lid_steps; ++k) {
    const Vec3 p = lid_edge(k);
    Paint paint;
    paint.lid = 1.0;
    rim.push_back(mesh.add(p, paint));
    const Vec3 q = p - eye_centre;
    // Straight back, towards the middle of the slit by a hair, so that the rim shows its thickness.
    const double side = std::max(q.x * q.x + q.y * q.y, 0.0);
    const double r = eye_radius + 0.015;
    const double z = side < r * r ? std::sqrt(r * r - side) : 0.0;
    const double depth = std::clamp(q.z - z, 0.10, 0.22);
    rest.push_back(mesh.add(eye_centre + Vec3(q.x * 0.985, q.y * 0.985, q.z - depth), paint));
  }
  bridge(mesh, outer, rim, true, Chart::outer);
  bridge(mesh, rim, rest, true, Chart::outer);

  // Socket: round the back of the ball, a little off it.
  Loop front = rest;
  for (int j = 0; j <= 5; ++j) {
    Loop loop;
    for (int k = 0; k < lid_steps; ++k) {
      const Vec3 p = lid_edge(k) - eye_centre;
      const double azimuth = std::atan2(p.y, p.x);
      const double at_edge = std::acos(std::clamp(p.z / glm::length(p), -1.0, 1.0));
      const double polar = glm::mix(at_edge + 0.05, 0.93 * pi, static_cast<double>(j) / 5.0);
      const double r = eye_radius + (j == 0 ? 0.06 : 0.12);
      Paint paint;
      paint.inner_uv = {static_cast<double>(j) / 5.0, 1.0};
      const Vec3 direction(std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth), std::cos(polar));
      loop.push_back(mesh.add(eye_centre + direction * r, paint));
    }
    bridge(mesh, front, loop, true, j == 0 ? Chart::outer : Chart::inner);
    front = loop;
  }
  Paint deep;
  deep.inner_uv = {1.0, 1.0};
  close_with_fan(mesh, front, true, mesh.add(eye_centre - Vec3(0.0, 0.0, eye_radius + 0.12), deep), Chart::inner);

  const std::size_t upper = lid_steps / 4;
  const std::size_t lower = 3 * lid_steps / 4;
  skin.marks["3.1"] = rim[upper];
  skin.marks["3.3"] = rim[lower];
  skin.marks["3.7"] = loops.back()[lid_steps / 2];
  skin.marks["3.11"] = loops.back()[0];
  skin.marks["3.13"] = loops[crease_ring][upper];
  skin.marks["3.9"] = loops[fold_ring][lower];
}

}  // namespace semblante::sample_head_detail
