#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "core/anatomy/mirror_plane.h"
#include "core/geometry/similarity.h"
#include "core/geometry/surface.h"
#include "core/geometry/triangle_tree.h"
#include "core/types/rig.h"

namespace semblante {

/// The surface of a head in the frame defined by its points: upright, one unit is about ES0. Vertices are surface
/// vertices.
class FaceSurface {
 public:
  /// `frame` maps positions of `surface` to this frame. `triangles`: of file vertices, may be empty. Keeps a reference
  /// to `surface`.
  FaceSurface(const Surface& surface, std::span<const Part> parts, const Similarity& frame,
              std::span<const Triangle> triangles = {});

  [[nodiscard]] const Surface& surface() const { return surface_; }
  [[nodiscard]] const glm::dvec3& at(std::uint32_t vertex) const { return places_[vertex]; }
  [[nodiscard]] const std::vector<glm::dvec3>& places() const { return places_; }  ///< #S, by vertex
  /// Whether the surface at a vertex faces forward (front_points.h), as the inner wall of a double surface does not
  /// behind the face. Always without triangles.
  [[nodiscard]] bool faces_forward_at(std::uint32_t vertex) const {
    return faces_forward_.empty() || faces_forward_[vertex];
  }
  /// Vertices of all parts with this role, increasing, without unused vertices.
  [[nodiscard]] const std::vector<std::uint32_t>& with_role(PartRole role) const;

  using Filter = std::function<bool(std::uint32_t)>;
  /// The vertex of the role nearest to `place`; with a plane, the distance from it is penalized. Considers only
  /// vertices that pass the filter, if given.
  [[nodiscard]] std::optional<std::uint32_t> nearest(PartRole role, const glm::dvec3& place,
                                                     const MirrorPlane* on = nullptr, const Filter& filter = {}) const;
  /// The place on the triangles of the role that is nearest to `place`, where a point would get a vertex of its own;
  /// empty where it means a vertex (insert_vertices.h), where another part is as near, and without triangles.
  /// `forward_only`: on triangles that face forward.
  [[nodiscard]] std::optional<glm::dvec3> nearest_between(PartRole role, const glm::dvec3& place,
                                                          bool forward_only) const;
  /// Hill climbing: the farthest vertex along `direction` reachable from `start` by ascending edges, at most `within`
  /// away; with a plane, along vertices on it. Tolerates ripples of one edge length.
  [[nodiscard]] std::uint32_t climb(std::uint32_t start, const glm::dvec3& direction, double within,
                                    const MirrorPlane* on = nullptr) const;
  /// The farthest vertex along `direction` of the vertices of `role` within `within` of `place` (and on the plane, if
  /// given).
  [[nodiscard]] std::optional<std::uint32_t> farthest(PartRole role, const glm::dvec3& place, double within,
                                                      const glm::dvec3& direction,
                                                      const MirrorPlane* on = nullptr) const;
  /// Mean length of the edges at a vertex.
  [[nodiscard]] double spacing(std::uint32_t vertex) const;
  /// Whether the vertex is on the plane, within the resolution of the mesh.
  [[nodiscard]] bool is_on(const MirrorPlane& plane, std::uint32_t vertex) const;

 private:
  const Surface& surface_;
  std::vector<glm::dvec3> places_;
  std::array<std::vector<std::uint32_t>, part_role_names.size()> by_role_;
  std::vector<PartRole> role_of_;       ///< #S
  std::vector<bool> faces_forward_;     ///< #S, or empty
  std::vector<glm::vec3> corners_;      ///< #S, `places_` for the tree
  std::vector<Triangle> triangles_;     ///< into `corners_`
  std::optional<TriangleTree> nearby_;  ///< of `triangles_`, if there are any
  double unit_;                         ///< lengths of this frame per length of the surface's own
};

}  // namespace semblante
