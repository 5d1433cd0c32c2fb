#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "core/geometry/similarity.h"
#include "core/geometry/surface.h"
#include "core/propose/mirror_plane.h"
#include "core/types/rig.h"

namespace semblante {

/// The surface of a head in the frame its points gave it: upright, one unit is about ES0. Vertices are surface
/// vertices.
class FaceSurface {
 public:
  /// `frame` takes places of the surface's own frame into this one. Keeps a reference to `surface`.
  FaceSurface(const Surface& surface, std::span<const Part> parts, const Similarity& frame);

  [[nodiscard]] const Surface& surface() const { return surface_; }
  [[nodiscard]] const glm::dvec3& at(std::uint32_t vertex) const { return places_[vertex]; }
  /// Vertices of all parts with that role, rising. Vertices of no triangle are none.
  [[nodiscard]] const std::vector<std::uint32_t>& with_role(PartRole role) const;

  using Filter = std::function<bool(std::uint32_t)>;
  /// The vertex of that role nearest to `place`; with a plane, one off it counts as farther. Only vertices that the
  /// filter, if there is one, lets through.
  [[nodiscard]] std::optional<std::uint32_t> nearest(PartRole role, const glm::dvec3& place,
                                                     const MirrorPlane* on = nullptr, const Filter& filter = {}) const;
  /// The farthest vertex along `direction` that a way of rising edges leads to from `start`, no farther than `within`
  /// from it; with a plane, along vertices on it. Steps over ripples of an edge's length.
  [[nodiscard]] std::uint32_t climb(std::uint32_t start, const glm::dvec3& direction, double within,
                                    const MirrorPlane* on = nullptr) const;
  /// Of the vertices of `role` within `within` of `place` the farthest along `direction`; with a plane, of those on it.
  [[nodiscard]] std::optional<std::uint32_t> farthest(PartRole role, const glm::dvec3& place, double within,
                                                      const glm::dvec3& direction,
                                                      const MirrorPlane* on = nullptr) const;
  /// Length of the edges about a vertex, on average.
  [[nodiscard]] double spacing(std::uint32_t vertex) const;
  /// Whether the vertex lies on the plane as nearly as this mesh allows.
  [[nodiscard]] bool is_on(const MirrorPlane& plane, std::uint32_t vertex) const;

 private:
  const Surface& surface_;
  std::vector<glm::dvec3> places_;
  std::array<std::vector<std::uint32_t>, part_role_names.size()> by_role_;
  double unit_;  ///< lengths of this frame per length of the surface's own
};

}  // namespace semblante
