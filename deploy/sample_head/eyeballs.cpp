#include "deploy/sample_head/eyeballs.h"

#include <cmath>
#include <numbers>

#include "deploy/sample_head/sculpt.h"

namespace semblante::sample_head_detail {
namespace {

using std::numbers::pi;
constexpr int around = 32;
/// Rings by angle from the line of sight, in degrees. Close rings at the iris keep its rim round: iris_radius on the
/// ball is asin(0.655 / 1.42) = 27.5 degrees.
constexpr double ring_angles[] = {4.0, 9.0, 15.0, 21.5, 27.5, 33.0, 41.0, 52.0, 64.0, 80.0, 100.0, 125.0, 150.0};

}  // namespace

Eyeball make_eyeball(bool right, std::size_t material) {
  Eyeball eye;
  SampleHeadMesh& mesh = eye.mesh;
  mesh.name = right ? "right eye" : "left eye";
  mesh.material = material;
  const double side = right ? -1.0 : 1.0;
  const auto add = [&](double polar, double azimuth) {
    // Exact zeros and mirror pairs, because the ball is symmetric about its own vertical plane.
    const Vec3 n(std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth), std::cos(polar));
    const Vec3 p = eye_centre + n * eye_radius;
    mesh.positions.emplace_back(Vec3(side * p.x, p.y, p.z) * 0.01);
    mesh.normals.emplace_back(Vec3(side * n.x, n.y, n.z));
    // The texture shows the ball from the front; its back half is stretched to the corners.
    const double r = polar / pi;
    mesh.uvs.emplace_back(0.5 + side * 0.5 * r * std::cos(azimuth), 0.5 - 0.5 * r * std::sin(azimuth));
    return static_cast<std::uint32_t>(mesh.positions.size() - 1);
  };
  const auto triangle = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    mesh.triangles.push_back(right ? std::array{a, c, b} : std::array{a, b, c});
  };
  eye.pupil = add(0.0, 0.0);
  std::vector<std::uint32_t> before;
  for (const double degrees : ring_angles) {
    std::vector<std::uint32_t> ring;
    ring.reserve(around);
    for (int k = 0; k < around; ++k) ring.push_back(add(degrees * pi / 180.0, 2.0 * pi * k / around));
    for (std::size_t k = 0; k < around; ++k) {
      const std::size_t next = (k + 1) % around;
      if (before.empty()) {
        triangle(eye.pupil, ring[k], ring[next]);
      } else {
        triangle(before[k], ring[k], ring[next]);
        triangle(before[k], ring[next], before[next]);
      }
    }
    before = ring;
  }
  const std::uint32_t back = add(pi, 0.0);
  for (std::size_t k = 0; k < around; ++k) triangle(before[k], back, before[(k + 1) % around]);
  return eye;
}

}  // namespace semblante::sample_head_detail
