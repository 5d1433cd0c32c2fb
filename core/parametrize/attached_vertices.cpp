#include "core/parametrize/attached_vertices.h"

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <queue>

#include <glm/geometric.hpp>

#include "core/anatomy/lid_edge.h"
#include "core/geometry/nearest_vertex.h"

namespace semblante {
namespace {

/// Times that a vertex of a lash takes the mean of what its neighbours follow.
constexpr int smoothings = 4;

constexpr double infinite = std::numeric_limits<double>::infinity();

/// Of a length through the air, per length along the part.
constexpr double air = 4.0;

// Of lashes, in widths of the eye.
constexpr double root_from_edge = 0.15;  ///< their nearest vertex to the edge of the lid
constexpr double longest_lash = 1.0;     ///< no vertex is farther from it
constexpr double root = 0.03;            ///< a vertex so near to the edge is a root, and goes with it
constexpr double of_one_lid = 0.8;       ///< of their vertices are nearer to the edge of one lid than to the other's:
                                         ///< what fills the gap between lid and eye is at both

std::vector<SurfaceVertexId> vertices_of_skin(const Surface& surface, std::span<const Part> parts) {
  std::vector<SurfaceVertexId> vertices;
  for (std::uint32_t p = 0; p < parts.size(); ++p) {
    if (parts[p].role != PartRole::skin) continue;
    const auto members = surface.members_of(PartId(p));
    vertices.insert(vertices.end(), members.begin(), members.end());
  }
  return vertices;
}

/// Each of the vertices follows what it and its neighbours follow, in equal parts, but for those that are `fixed`.
void smooth(const Surface& surface, std::span<const SurfaceVertexId> vertices, const std::vector<bool>& fixed,
            std::vector<std::vector<FollowedVertex>>& followed) {
  for (int k = 0; k < smoothings; ++k) {
    std::vector<std::vector<FollowedVertex>> next;
    for (const SurfaceVertexId v : vertices) {
      std::map<SurfaceVertexId, double> shares;
      double count = 0.0;
      const auto add = [&](SurfaceVertexId from) {
        for (const FollowedVertex& f : followed[from.value()]) shares[f.vertex] += f.share;
        count += 1.0;
      };
      add(v);
      if (!fixed[v.value()]) {
        for (const Surface::Step& step : surface.steps_from(v)) add(step.to);
      }
      std::vector<FollowedVertex>& mean = next.emplace_back();
      for (const auto& [vertex, share] : shares) mean.push_back({vertex, share / count});
    }
    for (std::size_t i = 0; i < vertices.size(); ++i) followed[vertices[i].value()] = std::move(next[i]);
  }
}

/// The edges of the lids of one eye.
struct EdgesOfEye {
  NearestVertex upper, lower;
  double width;
  bool is_closed;
};

std::vector<EdgesOfEye> edges_of_eyes(const Surface& surface, std::span<const Part> parts,
                                      std::span<const SurfacePoint> points) {
  const auto vertices_of = [](const LidEdge& edge) {
    std::vector<SurfaceVertexId> vertices = edge.to_corner[0];
    vertices.insert(vertices.end(), edge.to_corner[1].begin(), edge.to_corner[1].end());
    return vertices;
  };
  const auto is_skin = [&](const LidEdge& edge) {
    return parts[surface.part_of[edge.middle.vertex.value()].value()].role == PartRole::skin;
  };
  std::vector<EdgesOfEye> eyes;
  for (std::size_t eye = 0; eye < 2; ++eye) {
    const std::optional<EyeEdges> edges = find_eye_edges(surface, points, eye, parts);
    if (!edges || !is_skin(edges->upper) || !is_skin(edges->lower)) continue;
    const double width = glm::distance(edges->upper.corners[0].position, edges->upper.corners[1].position);
    const double opening = edges->upper.middle.position.y - edges->lower.middle.position.y;
    eyes.push_back({NearestVertex(surface, vertices_of(edges->upper)),
                    NearestVertex(surface, vertices_of(edges->lower)), width, opening < closed_height * width});
  }
  return eyes;
}

/// A part that begins at the lids of an eye and ends near them.
struct PartAtLids {
  PartId part;
  EdgesOfEye* eye;
  double at_upper;  ///< of its vertices, by which share they are nearer to the edge of the upper lid
};

std::optional<PartAtLids> at_lids(const Surface& surface, PartId part, std::span<EdgesOfEye> eyes) {
  const auto members = surface.members_of(part);
  for (EdgesOfEye& eye : eyes) {
    double nearest = infinite;
    double farthest = 0.0;
    std::size_t at_upper = 0;
    for (const SurfaceVertexId v : members) {
      const double to_upper = eye.upper.nearest(surface.positions[v.value()]).distance;
      const double to_lower = eye.lower.nearest(surface.positions[v.value()]).distance;
      at_upper += to_upper < to_lower ? 1 : 0;
      nearest = std::min({nearest, to_upper, to_lower});
      farthest = std::max(farthest, std::min(to_upper, to_lower));
    }
    if (nearest > root_from_edge * eye.width || farthest > longest_lash * eye.width) continue;
    return PartAtLids{part, &eye, static_cast<double>(at_upper) / static_cast<double>(members.size())};
  }
  return std::nullopt;
}

/// The edge of the lid whose lash a part is.
struct EdgeOfLash {
  NearestVertex* edge = nullptr;  ///< null if the part is no lash
  double eye_width = 0.0;
};

/// By part. Where an eye is closed, its edges lie on each other and the lashes of both lids point the same way, over
/// the lower one: the upper lid's are those that are nearer to its edge than the others are.
std::vector<EdgeOfLash> edges_of_lashes(const Surface& surface, std::span<const Part> parts,
                                        std::span<EdgesOfEye> eyes) {
  std::vector<EdgeOfLash> result(parts.size());
  std::vector<PartAtLids> found;
  for (std::uint32_t p = 0; p < parts.size(); ++p) {
    if (parts[p].role != PartRole::attached) continue;
    if (const auto part = at_lids(surface, PartId(p), eyes)) found.push_back(*part);
  }
  for (const PartAtLids& lash : found) {
    EdgesOfEye& eye = *lash.eye;
    double least = 0.0;
    double greatest = 1.0;
    if (eye.is_closed) {
      least = greatest = lash.at_upper;
      for (const PartAtLids& other : found) {
        if (other.eye != lash.eye) continue;
        least = std::min(least, other.at_upper);
        greatest = std::max(greatest, other.at_upper);
      }
    }
    // A single row of lashes is the upper lid's.
    const double upper = greatest > least ? (lash.at_upper - least) / (greatest - least) : 1.0;
    if (upper >= of_one_lid) result[lash.part.value()] = {&eye.upper, eye.width};
    if (upper <= 1.0 - of_one_lid) result[lash.part.value()] = {&eye.lower, eye.width};
  }
  return result;
}

}  // namespace

std::vector<std::vector<FollowedVertex>> followed_by_attached(const Surface& surface, std::span<const Part> parts,
                                                              std::span<const SurfacePoint> points) {
  std::vector<std::vector<FollowedVertex>> followed(surface.vertex_count());
  const auto is_attached = [](const Part& part) { return part.role == PartRole::attached; };
  if (std::none_of(parts.begin(), parts.end(), is_attached)) return followed;
  const std::vector<SurfaceVertexId> of_skin = vertices_of_skin(surface, parts);
  if (of_skin.empty()) return followed;
  std::optional<NearestVertex> skin;  // made for the first part that needs it: lashes do not
  std::vector<EdgesOfEye> eyes = edges_of_eyes(surface, parts, points);

  std::vector<double> cost(surface.vertex_count(), infinite);
  const std::vector<EdgeOfLash> edges = edges_of_lashes(surface, parts, eyes);
  std::vector<bool> is_root(surface.vertex_count(), false);
  std::vector<PartId> lashes;
  using Entry = std::pair<double, SurfaceVertexId>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  const auto lower = [&](SurfaceVertexId vertex, double to, SurfaceVertexId follows) {
    if (to >= cost[vertex.value()]) return;
    cost[vertex.value()] = to;
    followed[vertex.value()] = {{follows, 1.0}};
    queue.emplace(to, vertex);
  };
  for (std::uint32_t p = 0; p < parts.size(); ++p) {
    if (!is_attached(parts[p])) continue;
    const auto [edge, eye_width] = edges[p];
    if (edge != nullptr) {
      lashes.push_back(PartId(p));
    } else if (!skin) {
      skin.emplace(surface, of_skin);
    }
    for (const SurfaceVertexId v : surface.members_of(PartId(p))) {
      const NearestVertex::Hit hit = (edge != nullptr ? *edge : *skin).nearest(surface.positions[v.value()]);
      is_root[v.value()] = edge != nullptr && hit.distance < root * eye_width;
      lower(v, air * hit.distance, hit.vertex);
    }
  }
  while (!queue.empty()) {
    const auto [so_far, vertex] = queue.top();
    queue.pop();
    if (so_far > cost[vertex.value()]) continue;
    const SurfaceVertexId follows = followed[vertex.value()].front().vertex;
    for (const Surface::Step& step : surface.steps_from(vertex)) lower(step.to, so_far + step.length, follows);
  }
  for (const PartId part : lashes) smooth(surface, surface.members_of(part), is_root, followed);
  return followed;
}

}  // namespace semblante
