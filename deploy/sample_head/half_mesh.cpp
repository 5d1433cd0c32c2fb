#include "deploy/sample_head/half_mesh.h"

#include <algorithm>
#include <cassert>
#include <map>
#include <utility>

#include <glm/geometric.hpp>

namespace semblante::sample_head_detail {

void bridge(HalfMesh& mesh, const Loop& outside, const Loop& inside, bool closed, Chart chart) {
  assert(outside.size() == inside.size());
  const std::size_t steps = closed ? outside.size() : outside.size() - 1;
  for (std::size_t i = 0; i < steps; ++i) {
    const std::size_t next = (i + 1) % outside.size();
    if (inside[i] == inside[next]) {
      mesh.add_triangle(outside[i], outside[next], inside[i], chart);
    } else {
      mesh.add_quad(outside[i], outside[next], inside[next], inside[i], chart);
    }
  }
}

void bridge_doubling(HalfMesh& mesh, const Loop& outside, const Loop& inside, Chart chart) {
  assert(inside.size() == 2 * outside.size());
  for (std::size_t i = 0; i < outside.size(); ++i) {
    const int a = outside[i];
    const int b = outside[(i + 1) % outside.size()];
    const int middle = inside[2 * i + 1];
    mesh.add_triangle(a, b, middle, chart);
    mesh.add_triangle(a, middle, inside[2 * i], chart);
    mesh.add_triangle(b, inside[(2 * i + 2) % inside.size()], middle, chart);
  }
}

void close_with_fan(HalfMesh& mesh, const Loop& loop, bool closed, int centre, Chart chart) {
  const std::size_t steps = closed ? loop.size() : loop.size() - 1;
  for (std::size_t i = 0; i < steps; ++i) mesh.add_triangle(loop[i], loop[(i + 1) % loop.size()], centre, chart);
}

void orient(HalfMesh& mesh, const Vec3& first_looks) {
  const auto sides = [&](std::size_t f) { return mesh.faces[f].corner[3] < 0 ? std::size_t{3} : std::size_t{4}; };
  const auto edge_of = [&](std::size_t f, std::size_t i) {
    return std::pair(mesh.faces[f].corner[i], mesh.faces[f].corner[(i + 1) % sides(f)]);
  };
  const auto key_of = [](std::pair<int, int> e) { return e.first < e.second ? e : std::pair(e.second, e.first); };
  std::map<std::pair<int, int>, std::vector<std::size_t>> faces_of_edge;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    for (std::size_t i = 0; i < sides(f); ++i) faces_of_edge[key_of(edge_of(f, i))].push_back(f);
  }
  const auto flip = [&](std::size_t f) { std::swap(mesh.faces[f].corner[1], mesh.faces[f].corner[sides(f) - 1]); };
  const auto at = [&](int v) { return mesh.positions[static_cast<std::size_t>(v)]; };
  const auto& first = mesh.faces[0].corner;
  const Vec3 across = glm::cross(at(first[1]) - at(first[0]), at(first[2]) - at(first[0]));
  if (glm::dot(across, first_looks) < 0.0) flip(0);

  std::vector<bool> seen(mesh.faces.size(), false);
  std::vector<std::size_t> queue{0};
  seen[0] = true;
  while (!queue.empty()) {
    const std::size_t f = queue.back();
    queue.pop_back();
    for (std::size_t i = 0; i < sides(f); ++i) {
      const auto edge = edge_of(f, i);
      const auto& sharing = faces_of_edge[key_of(edge)];
      assert(sharing.size() <= 2);
      for (const std::size_t other : sharing) {
        if (seen[other]) continue;
        seen[other] = true;
        // Two faces have the same winding if they traverse their common edge in opposite directions.
        for (std::size_t j = 0; j < sides(other); ++j) {
          if (edge_of(other, j) == edge) {
            flip(other);
            break;
          }
        }
        queue.push_back(other);
      }
    }
  }
}

std::vector<std::vector<int>> neighbours_of(const HalfMesh& mesh) {
  std::vector<std::vector<int>> result(mesh.positions.size());
  for (const auto& face : mesh.faces) {
    const std::size_t count = face.corner[3] < 0 ? 3 : 4;
    for (std::size_t i = 0; i < count; ++i) {
      const int a = face.corner[i];
      const int b = face.corner[(i + 1) % count];
      result[static_cast<std::size_t>(a)].push_back(b);
      result[static_cast<std::size_t>(b)].push_back(a);
    }
  }
  for (auto& list : result) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  return result;
}

}  // namespace semblante::sample_head_detail
