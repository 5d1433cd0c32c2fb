#pragma once

// Include only in .cpp files of this folder, to keep OpenMesh out of other code.
#define _USE_MATH_DEFINES  // NOLINT(bugprone-reserved-identifier): asked for by OpenMesh

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <glm/vec3.hpp>

#include "core/lod/collapse_history.h"

namespace semblante {

struct GroupMeshTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
};

/// OpenMesh's mesh with faster versions of the two most frequent queries of its decimater: the library's versions check
/// every step and took two thirds of the total time.
class HalfEdgeMesh : public OpenMesh::TriMesh_ArrayKernelT<GroupMeshTraits> {
 public:
  /// Whether collapsing the half-edge, from its first vertex into its second, preserves the topology: the vertices have
  /// no common neighbours except those opposite to the edge, and no border is closed or cut off.
  [[nodiscard]] bool is_collapse_ok(HalfedgeHandle v0v1) const;

  [[nodiscard]] HalfedgeHandle find_halfedge(VertexHandle from, VertexHandle to) const;
};

/// The triangles of a group as a half-edge mesh, with further data for the rules of a collapse.
/// Vertices and faces are indexed by OpenMesh's handles.
struct GroupMesh {
  /// The current state of a triangle.
  struct Face {
    std::uint32_t source = 0;
    std::array<int, 3> vertices{};           ///< of the half-edge mesh
    std::array<std::uint32_t, 3> corners{};  ///< into Corners::corners
  };

  /// `sources` rise; none of the triangles names a surface vertex twice.
  GroupMesh(const DecimationMesh& all, std::span<const std::uint32_t> sources);

  [[nodiscard]] const Face& face(OpenMesh::FaceHandle f) const { return faces[static_cast<std::size_t>(f.idx())]; }
  [[nodiscard]] const glm::dvec3& position(std::size_t pose, int v) const {
    return positions[static_cast<std::size_t>(v) * pose_count + pose];
  }
  /// Whether the edge is a border, or the corners of its two triangles differ.
  [[nodiscard]] bool is_seam(OpenMesh::EdgeHandle edge) const;

  const DecimationMesh& all;
  HalfEdgeMesh mesh;
  std::size_t pose_count;  ///< with the neutral face, which is the first
  std::vector<Face> faces;
  std::vector<LevelTriangle> untouched;  ///< what makes no manifold with the others
  std::vector<glm::dvec3> positions;     ///< by vertex, then pose: what one collapse reads lies together
  std::vector<glm::dvec3> normals;       ///< by vertex, of the full neutral surface; length: area
  std::vector<double> importance;        ///< by vertex
  std::vector<bool> moves;               ///< by vertex: it or a neighbour differs in some pose
};

/// The corner of a face at one of its vertices.
std::uint32_t corner_at(const GroupMesh::Face& face, int vertex);

}  // namespace semblante
