#include "deploy/sample_head/emit.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include <glm/geometric.hpp>

namespace semblante::sample_head_detail {
namespace {

constexpr double metres = 0.01;

/// Angle-weighted vertex normals of the half, with the mirror half taken into account.
std::vector<Vec3> normals_of(const HalfMesh& half) {
  std::vector<Vec3> normals(half.positions.size(), Vec3(0.0));
  const auto at = [&](int v) { return half.positions[static_cast<std::size_t>(v)]; };
  for (const auto& face : half.faces) {
    const std::size_t count = face.corner[3] < 0 ? 3 : 4;
    for (std::size_t i = 0; i < count; ++i) {
      const int v = face.corner[i];
      const Vec3 a = at(face.corner[(i + 1) % count]) - at(v);
      const Vec3 b = at(face.corner[(i + count - 1) % count]) - at(v);
      const Vec3 across = glm::cross(a, b);
      const double sine = glm::length(across);
      if (sine < 1e-14) continue;
      normals[static_cast<std::size_t>(v)] += across / sine * std::atan2(sine, glm::dot(a, b));
    }
  }
  for (std::size_t v = 0; v < normals.size(); ++v) {
    if (half.on_mirror(static_cast<int>(v))) normals[v].x = 0.0;
    const double length = glm::length(normals[v]);
    normals[v] = length > 0.0 ? normals[v] / length : Vec3(0.0, 0.0, 1.0);
  }
  return normals;
}

}  // namespace

Vec2 outer_uv(const Vec3& p) {
  const double turn = std::atan2(std::abs(p.x), p.z + 1.0) / 3.14159265358979;  // 0 front .. 1 back
  const double u = 0.5 + 0.5 * (1.35 * turn - 0.35 * turn * turn);
  // Adds some depth to v, so that horizontal surfaces (under chin and nose) do not collapse to a line.
  const double v = (11.9 - p.y + 0.25 * (p.z - 2.0)) / 32.0;
  return {std::clamp(u, 0.5, 1.0), 0.01 + 0.92 * std::clamp(v, 0.0, 1.0)};
}

Vec2 inner_uv(const Paint& paint) { return {(0.04 + 0.92 * paint.inner_uv.x + paint.inner_uv.y) / 4.0, 0.975}; }

Vec2 skin_uv(const Vec3& p, const Paint& paint, Chart chart) {
  return chart == Chart::outer ? outer_uv(p) : inner_uv(paint);
}

EmittedMesh emit_symmetric(const std::string& name, std::size_t material, const HalfMesh& half, const UvOf& uv_of) {
  EmittedMesh result;
  SampleHeadMesh& mesh = result.mesh;
  mesh.name = name;
  mesh.material = material;
  const auto normals = normals_of(half);
  result.left.assign(half.positions.size(), UINT32_MAX);
  result.right.assign(half.positions.size(), UINT32_MAX);
  std::map<std::tuple<int, Chart, bool>, std::uint32_t> numbers;

  for (const bool right : {false, true}) {
    const auto number_of = [&](int v, Chart chart) {
      const auto i = static_cast<std::size_t>(v);
      const Vec3 p = half.positions[i];
      Vec2 uv = uv_of(p, half.paint[i], chart);
      // Both halves share the vertices of the mirror plane, except at the seam down the back of the head.
      const bool shared = half.on_mirror(v) && (chart == Chart::inner || uv.x < 0.5 + 1e-9);
      const auto [place, fresh] = numbers.try_emplace({v, chart, right && !shared}, mesh.positions.size());
      if (fresh) {
        const double side = right ? -1.0 : 1.0;
        if (right && chart == Chart::outer) uv.x = 1.0 - uv.x;
        const double x = half.on_mirror(v) ? 0.0 : side * p.x;
        const double nx = half.on_mirror(v) ? 0.0 : side * normals[i].x;
        mesh.positions.emplace_back(Vec3(x, p.y, p.z) * metres);
        mesh.normals.emplace_back(nx, normals[i].y, normals[i].z);
        mesh.uvs.emplace_back(uv);
      }
      auto& one = right ? result.right[i] : result.left[i];
      one = std::min(one, place->second);
      return place->second;
    };
    for (const auto& face : half.faces) {
      std::array<std::uint32_t, 4> n{};
      const std::size_t count = face.corner[3] < 0 ? 3 : 4;
      for (std::size_t i = 0; i < count; ++i) n[i] = number_of(face.corner[i], face.chart);
      // The mirror image has the opposite winding.
      const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        mesh.triangles.push_back(right ? std::array{a, c, b} : std::array{a, b, c});
      };
      add(n[0], n[1], n[2]);
      if (count == 4) add(n[0], n[2], n[3]);
    }
  }
  return result;
}

}  // namespace semblante::sample_head_detail
