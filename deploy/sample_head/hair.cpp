#include "deploy/sample_head/hair.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "deploy/sample_head/sculpt.h"

namespace semblante::sample_head_detail {
namespace {

using std::numbers::pi;

struct BorderPoint {
  double azimuth, elevation;  ///< degrees
};

/// Forehead, temple, sideburn, arch over the ear, nape.
constexpr std::array<BorderPoint, 15> border_points = {{{0, 31},
                                                        {15, 32},
                                                        {30, 30},
                                                        {42, 23.5},
                                                        {52, 12.5},
                                                        {60, 0},
                                                        {67, -9},
                                                        {73, -13},
                                                        {79, -12},
                                                        {86, -3},
                                                        {96, 2},
                                                        {108, -5},
                                                        {122, -21},
                                                        {142, -35},
                                                        {180, -40}}};

/// Strands from the forehead over the crown to the nape: lines of equal angle about an axis whose ends are under the
/// border of the hair, so that no strands are seen to meet.
double angle_across(const Vec3& p) {
  const double up = 0.943 * (p.y + 2.5) - 0.333 * p.z;
  return std::atan2(p.x, std::max(up, 0.3));
}

/// Thickness of the hair in cm at azimuth a, t = 0 at the border .. 1 at the crown.
double thickness(double a, double t, const Vec3& p) {
  const double front = 0.5 + 0.5 * std::cos(a);
  // The locks are off the forehead, whose skin moves under them.
  // Behind it is cut short at the border, and tapers into the neck.
  const double full = glm::mix(0.45, 0.85, glm::smoothstep(1.6, 2.4, a));
  const double body = 0.12 + 0.16 * glm::smoothstep(1.3, 0.9, a) + 0.80 * glm::smoothstep(0.0, full, t) +
                      0.95 * front * front * glm::smoothstep(0.0, 0.26, t) * (1.0 - glm::smoothstep(0.40, 1.0, t));
  const double lock = std::abs(std::sin(5.5 * angle_across(p) + 0.5 * std::sin(0.45 * p.z) + 0.4));
  const double groove = std::pow(1.0 - lock, 1.6) * glm::smoothstep(0.0, 0.12, t);
  return body - 0.38 * groove;
}

/// Locks that fall over the forehead: how far below the roots, tips and the gaps between them. Swept outwards.
struct LockPoint {
  double azimuth, fall;  ///< degrees
};
constexpr std::array<LockPoint, 14> locks = {{{0, 4.5},
                                              {5, 6},
                                              {10, 3.5},
                                              {15, 5},
                                              {20, 7},
                                              {25, 4},
                                              {32.5, 6.5},
                                              {37.5, 3.5},
                                              {45, 5},
                                              {50, 2},
                                              {57.5, 3},
                                              {62.5, 1},
                                              {70, 0},
                                              {180, 0}}};

double fringe(double azimuth) {
  const double degrees = std::clamp(azimuth * 180.0 / pi, 0.0, 180.0);
  const auto next = std::upper_bound(locks.begin(), locks.end() - 1, degrees,
                                     [](double at, const LockPoint& p) { return at < p.azimuth; });
  const auto before = next - 1;
  const double t = (degrees - before->azimuth) / (next->azimuth - before->azimuth);
  return glm::mix(before->fall, next->fall, t) * pi / 180.0;
}

}  // namespace

double hairline(double azimuth) {
  const double degrees = std::clamp(azimuth * 180.0 / pi, 0.0, 180.0);
  std::size_t i = 0;
  while (i + 2 < border_points.size() && border_points[i + 1].azimuth < degrees) ++i;
  const auto at = [&](std::size_t k) { return border_points[std::min(k, border_points.size() - 1)].elevation; };
  const double t = (degrees - border_points[i].azimuth) / (border_points[i + 1].azimuth - border_points[i].azimuth);
  const double before = i == 0 ? at(0) : at(i - 1);
  const double m0 = 0.5 * (at(i + 1) - before);
  const double m1 = 0.5 * (at(i + 2) - at(i));
  const double t2 = t * t;
  const double t3 = t2 * t;
  const double e =
      (2 * t3 - 3 * t2 + 1) * at(i) + (t3 - 2 * t2 + t) * m0 + (3 * t2 - 2 * t3) * at(i + 1) + (t3 - t2) * m1;
  // Locks: the border is not a drawn line.
  const double locks = 0.8 * std::sin(0.31 * degrees + 0.6) + 0.35 * std::sin(0.83 * degrees);
  return (e + locks * glm::smoothstep(75.0, 40.0, degrees)) * pi / 180.0;
}

Hair make_hair() {
  constexpr int columns = 72;  // the locks end at columns
  constexpr int rows = 16;
  Hair hair;
  HalfMesh& mesh = hair.mesh;
  const auto place = [&](int column, double t, double offset_scale, double sink) {
    const double a = pi * column / columns;
    const double elevation = glm::mix(hairline(a) - fringe(a), 0.5 * pi, t);
    Vec3 direction(std::cos(elevation) * std::sin(a), std::sin(elevation), std::cos(elevation) * std::cos(a));
    if (column == 0 || column == columns) direction.x = 0.0;
    const Vec3 foot = cast_from_inside(hair_centre, direction);
    Vec3 n = head_normal(foot);
    if (direction.x == 0.0) n = glm::normalize(Vec3(0.0, n.y, n.z));
    return foot + n * (offset_scale * thickness(a, t, foot) - sink);
  };
  std::vector<Loop> rings;
  const auto add_ring = [&](double t, double scale, double sink) {
    Loop ring;
    for (int c = 0; c <= columns; ++c) ring.push_back(mesh.add(place(c, t, scale, sink)));
    if (!rings.empty()) bridge(mesh, rings.back(), ring, false, Chart::outer);
    rings.push_back(ring);
  };
  add_ring(0.03, 0.0, 0.25);  // tucked under the skin
  add_ring(0.0, 0.0, -0.02);  // the border
  add_ring(0.0, 0.5, 0.0);    // and its thickness
  for (int r = 0; r < rows; ++r) add_ring(0.02 + 0.96 * std::pow(static_cast<double>(r) / (rows - 1), 1.1), 1.0, 0.0);
  const Vec3 crown = cast_from_inside(hair_centre, {0.0, 1.0, 0.0});
  hair.top = mesh.add(crown + Vec3(0.0, thickness(0.0, 1.0, crown), 0.0));
  close_with_fan(mesh, rings.back(), false, hair.top, Chart::outer);
  // The first face is the tucked ring at the forehead, whose normal points inwards and down.
  orient(mesh, {0.0, -1.0, -0.2});
  return hair;
}

Vec2 hair_uv(const Vec3& p) {
  return {std::clamp(0.5 + angle_across(p) / pi, 0.0, 1.0), std::clamp(0.5 - p.z / 26.0, 0.0, 1.0)};
}

Vec2 brow_line(double t) {
  // Rises to its highest point in the middle of its width (4.3), then falls to a fine end.
  const double x = glm::mix(1.2, 5.1, t);
  const double y = 1.90 + 0.38 * std::sin(pi * std::pow(t, 1.1)) + 0.24 * t;
  return {x, y};
}

double brow_half_height(double t) {
  return 0.30 * std::pow(std::max(1.0 - std::pow(t, 2.2), 0.0), 0.8) * (0.5 + 0.5 * glm::smoothstep(0.0, 0.22, t)) +
         0.02;
}

}  // namespace semblante::sample_head_detail
