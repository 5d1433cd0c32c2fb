#include "deploy/sample_head/sculpt.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace semblante::sample_head_detail {
namespace {

double ellipsoid(const Vec3& p, const Vec3& centre, const Vec3& radii) {
  const Vec3 q = p - centre;
  const double k0 = glm::length(q / radii);
  const double k1 = glm::length(q / (radii * radii));
  return k1 > 0.0 ? k0 * (k0 - 1.0) / k1 : -std::min({radii.x, radii.y, radii.z});
}

/// A capsule whose radius changes from ra at a to rb at b.
double capsule(const Vec3& p, const Vec3& a, const Vec3& b, double ra, double rb) {
  const Vec3 ab = b - a;
  const double t = std::clamp(glm::dot(p - a, ab) / glm::dot(ab, ab), 0.0, 1.0);
  return glm::length(p - a - ab * t) - (ra + (rb - ra) * t);
}

/// Union with a fillet of size k.
double join(double a, double b, double k) {
  const double h = std::max(k - std::abs(a - b), 0.0) / k;
  return std::min(a, b) - h * h * h * k / 6.0;
}

/// `a` minus `b`, with a rounded rim of size k.
double carve(double a, double b, double k) { return -join(-a, b, k); }

double bridge_distance(const Vec3& q) { return capsule(q, {0.0, 0.9, 7.75}, {0.0, -3.1, 10.0}, 0.98, 0.84); }

double nose_end_distance(const Vec3& q) {
  double d = ellipsoid(q, {0.0, -3.62, 10.36}, {0.98, 0.82, 0.94});                // tip
  d = join(d, ellipsoid(q, {0.98, -3.92, 9.55}, {0.62, 0.62, 0.90}), 0.9);         // wing
  d = join(d, capsule(q, {0.0, -4.42, 9.4}, {0.0, -4.1, 10.5}, 0.34, 0.42), 0.5);  // columella
  return carve(d, ellipsoid(q, {0.60, -4.72, 9.92}, {0.30, 0.40, 0.52}), 0.35);    // nostril
}

/// Neck, shoulders and chest.
double bust_distance(const Vec3& q) {
  double d = capsule(q, {0.0, -5.5, -3.0}, {0.0, -16.0, -4.3}, 4.3, 4.8);            // neck
  d = join(d, capsule(q, {4.4, -6.0, -2.2}, {1.6, -17.5, 0.0}, 0.7, 0.7), 2.4);      // sternomastoid
  d = join(d, capsule(q, {0.0, -14.6, -5.6}, {9.5, -19.9, -5.0}, 2.5, 2.4), 4.0);    // trapezius
  d = join(d, capsule(q, {11.4, -22.6, -4.4}, {12.6, -28.0, -4.2}, 4.3, 4.4), 4.0);  // shoulder
  return join(d, ellipsoid(q, {0.0, -26.0, -4.4}, {12.5, 8.8, 8.8}), 3.0);           // chest
}

}  // namespace

double skull_distance(const Vec3& p) {
  const Vec3 q(std::abs(p.x), p.y, p.z);
  double d = ellipsoid(q, {0.0, 3.5, -0.9}, {7.45, 7.8, 9.0});           // brain case
  return join(d, ellipsoid(q, {0.0, 3.4, 2.2}, {6.3, 5.6, 6.75}), 2.0);  // forehead
}

double head_distance(const Vec3& p) {
  const Vec3 q(std::abs(p.x), p.y, p.z);
  double d = skull_distance(q);
  d = join(d, ellipsoid(q, {0.0, -1.2, 1.8}, {6.95, 6.5, 6.6}), 1.8);             // middle of the face
  d = join(d, ellipsoid(q, {0.0, -4.7, 2.8}, {5.6, 6.1, 6.2}), 2.4);              // lower face
  d = join(d, ellipsoid(q, {3.05, -5.0, 1.4}, {1.8, 2.6, 2.8}), 2.8);             // angle of the jaw
  d = join(d, ellipsoid(q, {4.1, -1.9, 4.7}, {2.2, 1.6, 2.4}), 2.4);              // cheek bone
  d = join(d, ellipsoid(q, {3.3, -3.6, 6.0}, {2.0, 2.0, 1.9}), 2.2);              // apple of the cheek
  d = join(d, ellipsoid(q, {0.0, -6.6, 6.1}, {3.2, 2.5, 3.3}), 2.0);              // muzzle, over the teeth
  d = join(d, ellipsoid(q, {0.0, -9.4, 7.45}, {1.55, 1.6, 1.85}), 2.4);           // chin
  d = join(d, capsule(q, {3.55, -6.2, 2.4}, {2.5, -8.6, 5.3}, 1.0, 1.08), 2.4);   // edge of the jaw, in two
  d = join(d, capsule(q, {2.5, -8.6, 5.3}, {1.1, -9.68, 7.05}, 1.08, 1.1), 2.4);  // pieces: a curve
  d = join(d, capsule(q, {1.0, 1.9, 7.95}, {4.6, 1.8, 6.2}, 0.70, 0.66), 2.2);    // brow ridge
  d = carve(d, ellipsoid(q, {3.1, -0.1, 9.1}, {1.9, 1.45, 1.9}), 1.6);            // eye socket
  d = join(d, ellipsoid(q, eye_centre, Vec3(eye_radius + 0.15)), 0.5);            // lids over the ball
  d = join(d, capsule(q, {2.2, 1.36, 7.95}, {4.6, 1.2, 7.25}, 0.42, 0.45), 0.7);  // fold over the upper lid
  d = join(d, bridge_distance(q), 2.3);
  d = join(d, nose_end_distance(q), 1.15);
  d = join(d, capsule(q, {0.0, -8.7, 3.0}, {0.0, -12.6, -0.8}, 1.4, 2.0), 2.4);  // floor of the mouth and throat
  return join(d, bust_distance(q), 3.8);
}

Vec3 head_normal(const Vec3& p) {
  constexpr double h = 1e-4;
  return glm::normalize(Vec3(head_distance(p + Vec3(h, 0, 0)) - head_distance(p - Vec3(h, 0, 0)),
                             head_distance(p + Vec3(0, h, 0)) - head_distance(p - Vec3(0, h, 0)),
                             head_distance(p + Vec3(0, 0, h)) - head_distance(p - Vec3(0, 0, h))));
}

Vec3 project_to_head(const Vec3& p) {
  Vec3 q = p;
  for (int i = 0; i < 6; ++i) q -= head_normal(q) * (head_distance(q) * 0.95);
  if (p.x == 0.0) q.x = 0.0;
  return q;
}

double front_z(double x, double y) {
  double z = 14.0;
  // Sphere tracing with short steps: smooth unions of ellipsoids distort the distance, but by less than half.
  for (int i = 0; i < 400; ++i) {
    const double d = head_distance({x, y, z});
    if (d < 1e-9) break;
    z -= std::max(0.6 * d, 1e-6);
  }
  return z;
}

Vec3 cast_from_inside(const Vec3& origin, const Vec3& direction) {
  const Vec3 unit = glm::normalize(direction);
  double t = 0.0;
  for (int i = 0; i < 400; ++i) {
    const double d = head_distance(origin + unit * t);
    if (d > -1e-9) break;
    t -= std::min(0.6 * d, -1e-6);
  }
  return origin + unit * t;
}

}  // namespace semblante::sample_head_detail
