#include "deploy/sample_head/subdivide.h"

#include <algorithm>
#include <cassert>
#include <map>
#include <utility>

#include <glm/geometric.hpp>

namespace semblante::sample_head_detail {
namespace {

using EdgeKey = std::pair<int, int>;
EdgeKey edge_key(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

struct Edge {
  int vertex = -1;     ///< the new vertex on it
  Vec3 face_sum{0.0};  ///< sum of adjacent face points
  int face_count = 0;
};

Vec3 flattened(const Vec3& v) { return {0.0, v.y, v.z}; }

}  // namespace

HalfMesh subdivide(const HalfMesh& mesh) {
  HalfMesh result;
  result.positions = mesh.positions;
  result.paint = mesh.paint;
  const std::size_t old_count = mesh.positions.size();

  std::map<EdgeKey, Edge> edges;
  std::vector<int> face_vertex;
  std::vector<Vec3> face_sum(old_count, Vec3(0.0));
  std::vector<int> face_count(old_count, 0);
  for (const auto& face : mesh.faces) {
    assert(face.corner[3] >= 0);
    Vec3 centre(0.0);
    for (const int v : face.corner) centre += mesh.positions[static_cast<std::size_t>(v)] * 0.25;
    face_vertex.push_back(result.add(centre));
    for (std::size_t i = 0; i < 4; ++i) {
      auto& edge = edges[edge_key(face.corner[i], face.corner[(i + 1) % 4])];
      edge.face_sum += centre;
      ++edge.face_count;
      face_sum[static_cast<std::size_t>(face.corner[i])] += centre;
      ++face_count[static_cast<std::size_t>(face.corner[i])];
    }
  }

  std::vector<Vec3> middle_sum(old_count, Vec3(0.0));  // of all edges at a vertex, mirrored ones included
  std::vector<int> middle_count(old_count, 0);
  std::vector<Vec3> border_sum(old_count, Vec3(0.0));  // of the border edges at a vertex
  std::vector<int> border_count(old_count, 0);
  for (auto& [key, edge] : edges) {
    const Vec3 a = mesh.positions[static_cast<std::size_t>(key.first)];
    const Vec3 b = mesh.positions[static_cast<std::size_t>(key.second)];
    const Vec3 middle = (a + b) * 0.5;
    const bool mirror = mesh.on_mirror(key.first) && mesh.on_mirror(key.second) && edge.face_count == 1;
    const bool border = edge.face_count == 1 && !mirror;
    Vec3 point = middle;
    if (mirror) point = (a + b + flattened(edge.face_sum) * 2.0) * 0.25;
    if (edge.face_count == 2) point = (a + b + edge.face_sum) * 0.25;
    edge.vertex = result.add(point);
    for (const int v : {key.first, key.second}) {
      const auto i = static_cast<std::size_t>(v);
      const int weight = mesh.on_mirror(v) && !mirror ? 2 : 1;
      middle_sum[i] += (mesh.on_mirror(v) ? flattened(middle) : middle) * static_cast<double>(weight);
      middle_count[i] += weight;
      if (border) {
        border_sum[i] += (mesh.on_mirror(v) ? flattened(middle) : middle) * static_cast<double>(weight);
        border_count[i] += weight;
      }
    }
  }

  for (std::size_t v = 0; v < old_count; ++v) {
    const Vec3 p = mesh.positions[v];
    Vec3 moved;
    if (border_count[v] >= 2) {
      moved = (p + border_sum[v] / static_cast<double>(border_count[v])) * 0.5;
    } else {
      const double n = middle_count[v];
      const Vec3 f = face_sum[v] / static_cast<double>(face_count[v]);
      const Vec3 r = middle_sum[v] / n;
      moved = (f + r * 2.0 + p * (n - 3.0)) / n;
    }
    if (p.x == 0.0) moved.x = 0.0;
    result.positions[v] = moved;
  }

  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto& c = mesh.faces[f].corner;
    for (std::size_t i = 0; i < 4; ++i) {
      result.add_quad(c[i], edges[edge_key(c[i], c[(i + 1) % 4])].vertex, face_vertex[f],
                      edges[edge_key(c[i], c[(i + 3) % 4])].vertex, mesh.faces[f].chart);
    }
  }
  return result;
}

HalfMesh refine(const HalfMesh& mesh, const std::function<bool(const Vec3& centre)>& where) {
  HalfMesh result;
  result.positions = mesh.positions;
  result.paint = mesh.paint;
  const auto at = [&](int v) { return mesh.positions[static_cast<std::size_t>(v)]; };
  const auto centre_of = [&](const HalfMesh::Face& face) {
    const auto& c = face.corner;
    return (at(c[0]) + at(c[1]) + at(c[2]) + at(c[3])) * 0.25;
  };
  std::map<EdgeKey, int> middles;
  for (const auto& face : mesh.faces) {
    assert(face.corner[3] >= 0);
    if (!where(centre_of(face))) continue;
    for (std::size_t i = 0; i < 4; ++i) {
      const EdgeKey key = edge_key(face.corner[i], face.corner[(i + 1) % 4]);
      if (!middles.contains(key)) middles[key] = result.add((at(key.first) + at(key.second)) * 0.5);
    }
  }
  for (const auto& face : mesh.faces) {
    const auto& c = face.corner;
    std::array<int, 4> middle{};
    int split = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      const auto found = middles.find(edge_key(c[i], c[(i + 1) % 4]));
      middle[i] = found == middles.end() ? -1 : found->second;
      if (middle[i] >= 0) ++split;
    }
    if (split == 0) {
      result.faces.push_back(face);
      continue;
    }
    const int centre = result.add(centre_of(face));
    for (std::size_t i = 0; i < 4; ++i) {
      if (split == 4) {
        result.add_quad(c[i], middle[i], centre, middle[(i + 3) % 4], face.chart);
      } else if (middle[i] >= 0) {
        result.add_triangle(c[i], middle[i], centre, face.chart);
        result.add_triangle(middle[i], c[(i + 1) % 4], centre, face.chart);
      } else {
        result.add_triangle(c[i], c[(i + 1) % 4], centre, face.chart);
      }
    }
  }
  return result;
}

Loop boundary_loop(const HalfMesh& mesh, int start, const Vec3& towards) {
  std::map<EdgeKey, int> uses;
  for (const auto& face : mesh.faces) {
    const std::size_t count = face.corner[3] < 0 ? 3 : 4;
    for (std::size_t i = 0; i < count; ++i) ++uses[edge_key(face.corner[i], face.corner[(i + 1) % count])];
  }
  std::map<int, std::vector<int>> next;
  for (const auto& [key, count] : uses) {
    if (count != 1 || (mesh.on_mirror(key.first) && mesh.on_mirror(key.second))) continue;
    next[key.first].push_back(key.second);
    next[key.second].push_back(key.first);
  }
  const auto& first = next.at(start);
  const auto closeness = [&](int v) {
    const auto& p = mesh.positions;
    return glm::dot(p[static_cast<std::size_t>(v)] - p[static_cast<std::size_t>(start)], towards);
  };
  int current =
      *std::max_element(first.begin(), first.end(), [&](int a, int b) { return closeness(a) < closeness(b); });
  Loop loop{start};
  int previous = start;
  while (current != start) {
    loop.push_back(current);
    const auto& around = next.at(current);
    if (around.size() == 1) break;  // the mirror plane
    const int onward = around[0] == previous ? around[1] : around[0];
    previous = std::exchange(current, onward);
  }
  return loop;
}

}  // namespace semblante::sample_head_detail
