#include "deploy/sample_head/shirt.h"

#include <cmath>
#include <numbers>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "deploy/sample_head/sculpt.h"

namespace semblante::sample_head_detail {
namespace {

using std::numbers::pi;

constexpr int columns = 28;
inline const Vec3 centre{0.0, -20.5, -3.6};  ///< inside the chest: all rows are cast from here

/// A row of the cloth: `fall` from the collar (0) to the hem (1), `offset` from the skin in cm.
struct Row {
  double fall, offset;
};
// The collar is a band with an edge of its own; the last row is rolled in under the hem.
constexpr Row rows[] = {{0.03, -0.05}, {-0.015, 0.06}, {-0.02, 0.22}, {0.0, 0.32},  {0.045, 0.33},
                        {0.06, 0.27},  {0.065, 0.17},  {0.13, 0.16},  {0.22, 0.18}, {0.32, 0.20},
                        {0.42, 0.20},  {0.52, 0.20},   {0.62, 0.20},  {0.72, 0.20}, {0.81, 0.20},
                        {0.9, 0.20},   {0.97, 0.15},   {1.0, 0.0},    {1.0, -1.2}};

Vec3 turned(const Vec3& from, const Vec3& to, double share) {
  const double angle = std::acos(glm::clamp(glm::dot(from, to), -1.0, 1.0));
  return (from * std::sin((1.0 - share) * angle) + to * std::sin(share * angle)) / std::sin(angle);
}

/// The hem is level, and a little lower on chest and back than at the arms.
Vec3 hem_line(double azimuth) {
  const double height = -26.6 - 0.9 * std::pow(std::cos(azimuth), 2.0);
  return cast_from_inside({0.0, height, centre.z}, {std::sin(azimuth), 0.0, std::cos(azimuth)});
}

}  // namespace

Vec3 neckline(double azimuth) {
  const double back = 0.5 - 0.5 * std::cos(azimuth);
  const Vec3 inside(0.0, glm::mix(-17.6, -14.9, back), -3.4);
  const bool middle = azimuth == 0.0 || azimuth == pi;
  return cast_from_inside(inside, {middle ? 0.0 : std::sin(azimuth), 0.0, std::cos(azimuth)});
}

HalfMesh make_shirt() {
  HalfMesh mesh;
  Loop above;
  for (const Row& row : rows) {
    Loop loop;
    for (int c = 0; c <= columns; ++c) {
      const double azimuth = c == columns ? pi : pi * c / columns;
      const bool middle = c == 0 || c == columns;
      const Vec3 top = glm::normalize(neckline(azimuth) - centre);
      const Vec3 hem = glm::normalize(hem_line(azimuth) - centre);
      Vec3 direction = turned(top, hem, row.fall);
      if (middle) direction.x = 0.0;
      const Vec3 foot = cast_from_inside(centre, direction);
      Vec3 out = head_normal(foot);
      if (middle) out = glm::normalize(Vec3(0.0, out.y, out.z));
      loop.push_back(mesh.add(foot + out * row.offset));
    }
    if (!above.empty()) bridge(mesh, above, loop, false, Chart::outer);
    above = loop;
  }
  orient(mesh, {0.0, 0.0, -1.0});
  return mesh;
}

}  // namespace semblante::sample_head_detail
