#include "deploy/sample_head/eyelids.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "deploy/sample_head/sculpt.h"

namespace semblante::sample_head_detail {
namespace {

using std::numbers::pi;

// The opening, relative to the centre of the eye, in cm.
constexpr double inner_corner_y = -0.13;
constexpr double outer_corner_y = 0.12;
constexpr double inner_corner_z = 0.80;  ///< the inner corner is off the ball, towards the nose
constexpr double outer_corner_z = 0.62;

/// Height of the lid edges over the middle of the slit: tangent to the iris for the standard; the painted rim of the
/// iris goes on under them, because an eye whose whole iris is seen looks startled.
constexpr double lid_height = 0.57;
/// Height of the fold under which the upper lid slides, at the middle.
constexpr double fold_height = 0.88;
/// Distance of the skin in front of the ball's surface at the lower edge and at the fold.
constexpr double lower_thickness = 0.17;
constexpr double fold_front = 1.58;

/// y of the line from corner to corner at x.
double corner_line(double x) { return glm::mix(inner_corner_y, outer_corner_y, 0.5 + 0.5 * x / slit_half_width); }

struct LidPlace {
  double along;  ///< 0 inner corner .. 1 outer corner
  bool upper;
};

LidPlace lid_place(int k) {
  const bool upper = k <= lid_steps / 2;
  const double along = static_cast<double>(upper ? k : lid_steps - k) / (0.5 * lid_steps);
  return {along, upper};
}

/// A ring of the lids: its position between the edge (0) and the orbit (1), and its depth (cm) at the middle of upper
/// and lower lid.
struct LidRing {
  double upper, lower;
  double upper_sink, lower_sink;
};

// From the orbit inwards; the lower fold lies at 0.44.
constexpr LidRing rings[] = {
    {0.74, 0.82, 0.0, 0.0}, {0.48, 0.62, 0.0, 0.0}, {0.28, 0.44, 0.0, 0.03},
    {0.14, 0.26, 0.0, 0.0}, {0.05, 0.10, 0.0, 0.0},
};
constexpr std::size_t fold_ring = 2;

/// Depth of the line from corner to corner, and how near to a corner a place is; t from -1 to 1.
double corner_z(double t) { return glm::mix(inner_corner_z, outer_corner_z, 0.5 + 0.5 * t); }
double near_corner(double t) { return glm::smoothstep(0.55, 1.0, std::abs(t)); }

/// The fold, relative to the centre of the eye.
Vec3 fold_at(double t) {
  const double x = t * slit_half_width;
  const double y = corner_line(x) + (fold_height - corner_line(0.0)) * (1.0 - std::pow(std::abs(t), 2.1));
  const double z = std::sqrt(std::max(fold_front * fold_front - 0.85 * x * x, 0.0));
  return {x, y, glm::mix(z, corner_z(t), near_corner(t))};
}

/// The edge of the skin's opening at step k: along the fold above, along the lower lid below.
Vec3 opening_edge(int k) {
  const LidPlace place = lid_place(k);
  const double t = 2.0 * place.along - 1.0;
  const double x = t * slit_half_width;
  if (place.upper) return eye_centre + fold_at(t);
  const double corner = corner_z(t);
  const double to_corner = near_corner(t);
  const double y = lower_edge_y(x);
  const double r = eye_radius + lower_thickness;
  const double z = std::sqrt(std::max(r * r - x * x - y * y, 0.0));
  return eye_centre + Vec3(x, y, glm::mix(z, corner, to_corner));
}

}  // namespace

double lower_edge_y(double x) {
  const double t = std::min(std::abs(x) / slit_half_width, 1.0);
  // Fuller towards the nose, where the closing lid comes down farther for the slant of the slit.
  return corner_line(x) - (lid_height + corner_line(0.0)) * (1.0 - std::pow(t, x < 0.0 ? 2.1 : 1.85));
}

double fold_radius(double x) {
  const Vec3 fold = fold_at(std::clamp(x / slit_half_width, -1.0, 1.0));
  return std::hypot(fold.y, fold.z);
}

double upper_edge_y(double x) {
  const double t = std::min(std::abs(x) / slit_half_width, 1.0);
  return corner_line(x) + (lid_height - corner_line(0.0)) * (1.0 - std::pow(t, 2.3));
}

void add_eyelids(Skin& skin, const Loop& orbit) {
  HalfMesh& mesh = skin.mesh;
  const auto orbit_at = [&](int k) {
    return mesh.positions[static_cast<std::size_t>(orbit[static_cast<std::size_t>(k)])];
  };

  Loop outer = orbit;
  std::vector<Loop> loops;
  for (const LidRing& ring : rings) {
    Loop loop;
    for (int k = 0; k < lid_steps; ++k) {
      const LidPlace place = lid_place(k);
      const Vec3 edge = opening_edge(k);
      const double middle = std::sin(pi * place.along);  // 1 at the middle of the lid, 0 at the corners
      const double side = place.upper ? ring.upper : ring.lower;
      const double out = glm::mix(0.5 * (ring.upper + ring.lower), side, middle);
      Vec3 p = glm::mix(edge, orbit_at(k), out);
      const double z = front_z(p.x, p.y) - middle * (place.upper ? ring.upper_sink : ring.lower_sink);
      // The fold is in front of the sculpt; the lower lid is on it.
      const double trust =
          place.upper ? glm::smoothstep(0.1, 1.0, out) : std::max(middle, glm::smoothstep(0.05, 0.6, out));
      p.z = glm::mix(p.z, z, trust);
      loop.push_back(mesh.add(p));
    }
    bridge(mesh, outer, loop, true, Chart::outer);
    outer = loop;
    loops.push_back(loop);
  }

  // Edge: front rim, then a rim behind it, which is on the ball below, and leaves room for the upper lid above.
  Loop rim;
  Loop rest;
  for (int k = 0; k < lid_steps; ++k) {
    const bool upper = lid_place(k).upper;
    const Vec3 p = opening_edge(k);
    Paint paint;
    paint.lid = upper ? 0.0 : 1.0;
    paint.lash = upper ? 0.0 : 0.3;
    rim.push_back(mesh.add(p, paint));
    const Vec3 q = p - eye_centre;
    const double r = eye_radius + 0.015;
    const double side = q.x * q.x + q.y * q.y;
    const double z = side < r * r ? std::sqrt(r * r - side) : 0.0;
    const double middle = std::sin(pi * lid_place(k).along);
    const double depth = upper ? glm::mix(0.18, 0.09, middle) : std::clamp(q.z - z, 0.10, 0.22);
    const double rise = upper ? 0.07 * middle : 0.0;
    rest.push_back(mesh.add(eye_centre + Vec3(q.x * 0.985, q.y * 0.985 + rise, q.z - depth), paint));
  }
  bridge(mesh, outer, rim, true, Chart::outer);
  bridge(mesh, rim, rest, true, Chart::outer);

  // Socket: around the back of the ball, with enough distance for the upper lid to move.
  Loop front = rest;
  for (int j = 0; j <= 5; ++j) {
    Loop loop;
    for (int k = 0; k < lid_steps; ++k) {
      const Vec3 p = opening_edge(k) - eye_centre;
      const double azimuth = std::atan2(p.y, p.x);
      const double at_edge = std::acos(std::clamp(p.z / glm::length(p), -1.0, 1.0));
      const double polar = glm::mix(at_edge + 0.05, 0.93 * pi, static_cast<double>(j) / 5.0);
      const double roof = glm::smoothstep(0.35, 0.9, std::sin(azimuth));
      const double r = eye_radius + glm::mix(0.05, 0.40, roof * std::sin(pi * (j + 1.0) / 7.0));
      Paint paint;
      // Raised brows bare the roof.
      paint.inner_uv = {static_cast<double>(j) / 5.0 * (1.0 - 0.85 * roof), 1.0};
      const Vec3 direction(std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth), std::cos(polar));
      loop.push_back(mesh.add(eye_centre + direction * r, paint));
    }
    bridge(mesh, front, loop, true, j == 0 ? Chart::outer : Chart::inner);
    front = loop;
  }
  Paint deep;
  deep.inner_uv = {1.0, 1.0};
  close_with_fan(mesh, front, true, mesh.add(eye_centre - Vec3(0.0, 0.0, eye_radius + 0.12), deep), Chart::inner);

  const std::size_t lower = 3 * lid_steps / 4;
  skin.marks["3.3"] = rim[lower];
  skin.marks["3.7"] = loops.back()[lid_steps / 2];
  skin.marks["3.11"] = loops.back()[0];
  skin.marks["3.9"] = loops[fold_ring][lower];
}

}  // namespace semblante::sample_head_detail
