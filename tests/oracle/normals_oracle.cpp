#include "tests/oracle/normals_oracle.h"

#include <cmath>
#include <map>

namespace semblante::oracle {
namespace {

Vec3 minus(const Vec3& a, const Vec3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double dot(const Vec3& a, const Vec3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
double length(const Vec3& a) { return std::sqrt(dot(a, a)); }
Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

}  // namespace

std::vector<Vec3> normals(const std::vector<Vec3>& positions,
                          const std::vector<std::array<std::uint32_t, 3>>& triangles, const std::vector<float>& rest,
                          const std::vector<float>& rest_normals) {
  std::map<std::array<float, 6>, Vec3> sums;
  const auto place = [&](std::size_t v) {
    return std::array<float, 6>{rest[v * 3],         rest[v * 3 + 1],         rest[v * 3 + 2],
                                rest_normals[v * 3], rest_normals[v * 3 + 1], rest_normals[v * 3 + 2]};
  };
  for (const auto& triangle : triangles) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const Vec3& p = positions[triangle[corner]];
      const Vec3 a = minus(positions[triangle[(corner + 1) % 3]], p);
      const Vec3 b = minus(positions[triangle[(corner + 2) % 3]], p);
      const Vec3 across = cross(a, b);
      if (length(across) == 0.0) continue;
      const double sine = length(across) / (length(a) * length(b));
      Vec3& sum = sums[place(triangle[corner])];
      for (std::size_t i = 0; i < 3; ++i) {
        sum[i] += across[i] / length(across) * sine / (length(a) * length(b));
      }
    }
  }
  std::vector<Vec3> result;
  for (std::size_t v = 0; v < positions.size(); ++v) {
    const Vec3 sum = sums[place(v)];
    const double size = length(sum);
    result.push_back(size > 0.0 ? Vec3{sum[0] / size, sum[1] / size, sum[2] / size} : Vec3{0, 0, 1});
  }
  return result;
}

}  // namespace semblante::oracle
