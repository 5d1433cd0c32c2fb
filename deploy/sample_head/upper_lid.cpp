#include "deploy/sample_head/upper_lid.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <glm/common.hpp>

#include "deploy/sample_head/eyelids.h"
#include "deploy/sample_head/sculpt.h"

namespace semblante::sample_head_detail {
namespace {

constexpr int columns = 20;  // even: a column runs down the middle
constexpr double half_width = 1.38;
/// Radius of the sphere on which the edge of the lid is; the lid's front is vertical above it. The edge moves straight
/// down and must not touch the ball when it passes the ball's middle.
constexpr double front_radius = eye_radius + 0.14;

/// Distances about the line through the eye's centre along x, on which the lid rolls.
constexpr double behind_fold = 0.05;
constexpr double over_ball = 0.06;
double ball_radius(double x) { return std::sqrt(std::max(eye_radius * eye_radius - x * x, 0.0)); }

/// A row of the shell: `rise` above the edge, `back` behind the edge; both in cm.
struct Row {
  double rise, back;
  double lash;   ///< 1 on the lashes' tips
  double shade;  ///< texture: 0 lash .. 1 root
};
/// From the ball over the tips of the lashes up the front, behind the brow and over the ball to the root.
/// The roof is near the sphere about the eye's centre: the lid rolls about it, and a higher one would come out of the
/// skin above the fold.
constexpr Row rows[] = {
    {0.0, 0.13, 0.0, 0.0},   {0.0, 0.0, 1.0, 0.03},   {0.065, 0.0, 0.0, 0.13}, {0.12, -0.02, 0.0, 0.24},
    {0.22, -0.05, 0.0, 0.4}, {0.36, -0.07, 0.0, 0.6}, {0.50, -0.06, 0.0, 0.8}, {0.80, 0.26, 0.0, 1.0},
    {1.00, 0.55, 0.0, 1.0},  {1.12, 0.85, 0.0, 1.0},  {1.15, 1.10, 0.0, 1.0},  {1.12, 1.40, 0.0, 1.0},
    {0.95, 1.85, 0.0, 1.0},  {0.70, 2.35, 0.0, 1.0},  {0.40, 2.70, 0.0, 1.0},
};
constexpr std::size_t tips = 1;

/// By how much the lid of a closed eye has rolled down about the line through the eye's centre along x: until the tip
/// of the lashes, which is at `y` and `z` of the open eye, is at the lower lid.
double roll_of_closed(double x, double y, double z) {
  const double closed = lower_edge_y(x) + 0.05;
  return std::atan2(y, z) - std::asin(std::clamp(closed / std::hypot(y, z), -1.0, 1.0));
}

Vec3 rolled_down(const Vec3& p, double angle) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return {p.x, c * p.y - s * p.z, s * p.y + c * p.z};
}

}  // namespace

UpperLid make_upper_lid(bool closed) {
  UpperLid lid;
  HalfMesh& mesh = lid.mesh;
  std::vector<Loop> loops;
  for (const Row& row : rows) {
    Loop loop;
    for (int c = 0; c <= columns; ++c) {
      const double t = 2.0 * c / columns - 1.0;
      const double x = t * half_width;
      const double edge_y = upper_edge_y(x);
      const double edge_z = std::sqrt(std::max(front_radius * front_radius - x * x - edge_y * edge_y, 0.0));
      const double lash = 0.17 * (1.0 - std::pow(std::abs(t), 1.2));  // pointed at 3.1: everything else is behind it
      const double end = t * t * t * t;
      const double drawn_back = (t > 0.0 ? 0.33 : 0.24) * end * (1.0 - 0.6 * std::min(row.rise / 0.6, 1.0)) +
                                0.05 * t * t * std::min(row.rise, 1.1);
      Paint paint;
      // No lashes in the corners, where the shell is tucked in.
      paint.inner_uv = {std::max(row.shade, 0.4 * glm::smoothstep(0.80, 0.92, std::abs(t))), 3.0};
      // The ends recede under the corners of the skin.
      Vec3 p(x * (1.0 + 0.10 * row.lash), edge_y + row.rise,
             edge_z - row.back * (1.0 - 0.55 * t * t) + row.lash * lash - drawn_back);
      // What comes out from under the fold as the lid rolls passes behind its edge.
      const double most = std::max(fold_radius(p.x) - behind_fold, ball_radius(p.x) + over_ball);
      const double radius = std::hypot(p.y, p.z);
      if (row.lash == 0.0 && radius > most) p = {p.x, p.y * most / radius, p.z * most / radius};
      if (closed) p = rolled_down(p, roll_of_closed(x, edge_y, edge_z + lash));
      loop.push_back(mesh.add(eye_centre + p, paint));
    }
    if (!loops.empty()) bridge(mesh, loops.back(), loop, false, Chart::inner);
    loops.push_back(loop);
  }
  orient(mesh, {0.0, -1.0, 0.0});
  lid.marks["3.1"] = loops[tips][columns / 2];
  lid.marks["3.13"] = loops.back()[columns / 2];
  return lid;
}

}  // namespace semblante::sample_head_detail
