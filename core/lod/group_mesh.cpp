#include "core/lod/group_mesh.h"

#include <unordered_map>
#include <utility>

#include "core/geometry/triangle_shape.h"

namespace semblante {
namespace {

/// OpenMesh prints a message for every refused triangle; they are handled below, so the messages are disabled.
void silence_openmesh() {
  omlog().disable();
  omerr().disable();
}

/// Adds the vertices of the half-edge mesh, in the order of their first use by triangles.
class VertexNumbers {
 public:
  explicit VertexNumbers(GroupMesh& group) : group_(group) {}

  int operator()(std::uint32_t surface_vertex) {
    const DecimationMesh& all = group_.all;
    const auto [entry, added] = number_of_.try_emplace(surface_vertex, static_cast<int>(group_.mesh.n_vertices()));
    if (!added) return entry->second;
    const glm::dvec3& rest = all.positions[surface_vertex];
    const auto v = group_.mesh.add_vertex({rest.x, rest.y, rest.z});
    group_.positions.push_back(rest);
    bool moved = false;
    for (const auto& pose : all.poses) {
      group_.positions.push_back(pose[surface_vertex]);
      moved = moved || pose[surface_vertex] != rest;
    }
    group_.moves.push_back(moved);
    group_.importance.push_back(all.importance[surface_vertex]);
    if (all.fixed[surface_vertex]) group_.mesh.status(v).set_locked(true);
    return entry->second;
  }

 private:
  GroupMesh& group_;
  std::unordered_map<std::uint32_t, int> number_of_;
};

void add_faces(GroupMesh& group, std::span<const std::uint32_t> sources) {
  VertexNumbers number(group);
  for (const std::uint32_t source : sources) {
    GroupMesh::Face face;
    face.source = source;
    face.corners = group.all.corners.triangles[source];
    std::array<OpenMesh::VertexHandle, 3> handles;
    for (std::size_t c = 0; c < 3; ++c) {
      face.vertices[c] = number(group.all.corners.corners[face.corners[c]].surface_vertex);
      handles[c] = OpenMesh::VertexHandle(face.vertices[c]);
    }
    if (group.mesh.add_face(handles.data(), handles.size()).is_valid()) {
      group.faces.push_back(face);
      continue;
    }
    // A third triangle on an edge, or a duplicate triangle: it is kept with all its vertices.
    group.untouched.push_back({source, face.corners});
    for (const auto v : handles) group.mesh.status(v).set_locked(true);
  }
}

void measure_normals(GroupMesh& group) {
  group.normals.assign(group.mesh.n_vertices(), glm::dvec3(0.0));
  std::vector<bool> near_moving = group.moves;
  for (const GroupMesh::Face& f : group.faces) {
    const auto [a, b, c] = f.vertices;
    const glm::dvec3 area = area_vector(group.position(0, a), group.position(0, b), group.position(0, c));
    bool moving = false;
    for (const int v : f.vertices) {
      group.normals[static_cast<std::size_t>(v)] += area;
      moving = moving || group.moves[static_cast<std::size_t>(v)];
    }
    for (const int v : f.vertices) {
      if (moving) near_moving[static_cast<std::size_t>(v)] = true;
    }
  }
  group.moves = std::move(near_moving);
}

/// Locks vertices where two borders touch: a collapse could join or separate them.
void lock_touching_borders(HalfEdgeMesh& mesh) {
  for (const auto v : mesh.vertices()) {
    int gaps = 0;
    for (const auto half : mesh.voh_range(v)) gaps += mesh.is_boundary(half) ? 1 : 0;
    if (gaps > 1) mesh.status(v).set_locked(true);
  }
}

/// Locks vertices of very high valence. The check of a vertex is quadratic in its valence and repeated after every
/// adjacent collapse: the middle of a cap with a thousand triangles would take minutes. For unrealistically large fans
/// the rim is locked too.
void lock_hubs(HalfEdgeMesh& mesh) {
  constexpr unsigned hub = 64;
  constexpr unsigned huge_hub = 1024;
  for (const auto v : mesh.vertices()) {
    const unsigned neighbours = mesh.valence(v);
    if (neighbours <= hub) continue;
    mesh.status(v).set_locked(true);
    if (neighbours <= huge_hub) continue;
    for (const auto rim : mesh.vv_range(v)) mesh.status(rim).set_locked(true);
  }
}

}  // namespace

GroupMesh::GroupMesh(const DecimationMesh& input, std::span<const std::uint32_t> sources)
    : all(input), pose_count(1 + input.poses.size()) {
  silence_openmesh();
  mesh.request_vertex_status();
  mesh.request_edge_status();
  mesh.request_face_status();
  add_faces(*this, sources);
  measure_normals(*this);
  lock_touching_borders(mesh);
  lock_hubs(mesh);
}

bool HalfEdgeMesh::is_collapse_ok(HalfedgeHandle v0v1) const {
  const HalfedgeHandle v1v0 = opposite_halfedge_handle(v0v1);
  const VertexHandle v0 = to_vertex_handle(v1v0);
  const VertexHandle v1 = to_vertex_handle(v0v1);
  if (status(edge_handle(v0v1)).deleted() || status(v0).deleted() || status(v1).deleted()) return false;
  const bool border_left = is_boundary(v0v1);
  const bool border_right = is_boundary(v1v0);
  const auto is_ear = [&](HalfedgeHandle half) {
    const HalfedgeHandle after = next_halfedge_handle(half);
    return is_boundary(opposite_halfedge_handle(after)) &&
           is_boundary(opposite_halfedge_handle(next_halfedge_handle(after)));
  };
  if ((!border_left && is_ear(v0v1)) || (!border_right && is_ear(v1v0))) return false;
  const VertexHandle left = border_left ? VertexHandle() : to_vertex_handle(next_halfedge_handle(v0v1));
  const VertexHandle right = border_right ? VertexHandle() : to_vertex_handle(next_halfedge_handle(v1v0));
  if (left == right) return false;
  if (!border_left && !border_right && is_boundary(v0) && is_boundary(v1)) return false;
  for (HalfedgeHandle around = cw_rotated_halfedge_handle(v0v1); around != v0v1;
       around = cw_rotated_halfedge_handle(around)) {
    const VertexHandle neighbour = to_vertex_handle(around);
    if (neighbour != left && neighbour != right && find_halfedge(neighbour, v1).is_valid()) return false;
  }
  return true;
}

HalfEdgeMesh::HalfedgeHandle HalfEdgeMesh::find_halfedge(VertexHandle from, VertexHandle to) const {
  const HalfedgeHandle first = halfedge_handle(from);
  if (!first.is_valid()) return first;
  HalfedgeHandle around = first;
  do {
    if (to_vertex_handle(around) == to) return around;
    around = cw_rotated_halfedge_handle(around);
  } while (around != first);
  return HalfedgeHandle();
}

std::uint32_t corner_at(const GroupMesh::Face& face, int vertex) {
  for (std::size_t c = 0; c < 3; ++c) {
    if (face.vertices[c] == vertex) return face.corners[c];
  }
  return Model::no_index;
}

bool GroupMesh::is_seam(OpenMesh::EdgeHandle edge) const {
  const auto half = mesh.halfedge_handle(edge, 0);
  const auto left = mesh.face_handle(half);
  const auto right = mesh.face_handle(mesh.opposite_halfedge_handle(half));
  if (!left.is_valid() || !right.is_valid()) return true;
  const int a = mesh.from_vertex_handle(half).idx();
  const int b = mesh.to_vertex_handle(half).idx();
  return corner_at(face(left), a) != corner_at(face(right), a) || corner_at(face(left), b) != corner_at(face(right), b);
}

}  // namespace semblante
