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

/// Those of the triangles alone.
std::vector<Vec3> of_triangles(const std::vector<Vec3>& positions,
                               const std::vector<std::array<std::uint32_t, 3>>& triangles,
                               const std::vector<float>& rest, const std::vector<float>& rest_normals) {
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

/// `v` turned about a x b by the angle between them (Rodrigues).
Vec3 turned(const Vec3& v, const Vec3& a, const Vec3& b) {
  const Vec3 across = cross(a, b);
  const double sine = length(across);
  if (sine == 0.0) return dot(a, b) > 0.0 ? v : b;
  const Vec3 axis{across[0] / sine, across[1] / sine, across[2] / sine};
  const Vec3 aside = cross(axis, v);
  const double cosine = dot(a, b);
  Vec3 result{};
  for (std::size_t i = 0; i < 3; ++i) {
    result[i] = v[i] * cosine + aside[i] * sine + axis[i] * dot(axis, v) * (1.0 - cosine);
  }
  return result;
}

}  // namespace

std::vector<Vec3> normals(const std::vector<Vec3>& positions,
                          const std::vector<std::array<std::uint32_t, 3>>& triangles, const std::vector<float>& rest,
                          const std::vector<float>& rest_normals) {
  std::vector<Vec3> neutral;
  for (std::size_t v = 0; v < rest.size(); v += 3) neutral.push_back({rest[v], rest[v + 1], rest[v + 2]});
  const std::vector<Vec3> at_rest = of_triangles(neutral, triangles, rest, rest_normals);
  std::vector<Vec3> result = of_triangles(positions, triangles, rest, rest_normals);
  for (std::size_t v = 0; v < result.size(); ++v) {
    const Vec3 own{rest_normals[v * 3], rest_normals[v * 3 + 1], rest_normals[v * 3 + 2]};
    const double size = length(own);
    if (size == 0.0) continue;
    result[v] = turned({own[0] / size, own[1] / size, own[2] / size}, at_rest[v], result[v]);
  }
  return result;
}

}  // namespace semblante::oracle
