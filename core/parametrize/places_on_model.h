#pragma once

#include <cstdint>
#include <optional>

#include <glm/vec3.hpp>

#include "core/anatomy/rim_sides.h"
#include "core/geometry/surface.h"
#include "core/types/feature_points.h"
#include "core/types/model.h"

namespace semblante {

/// The side of an opening that a point of a lip or lid belongs to; only for vertices whose side is certain.
struct OwnSide {
  const RimSides& sides;
  bool is_upper;

  [[nodiscard]] bool has(SurfaceVertexId vertex) const { return sides.side(vertex, is_upper) >= RimSides::clear; }
  [[nodiscard]] bool is_opposite(SurfaceVertexId vertex) const {
    return sides.side(vertex, is_upper) <= -RimSides::clear;
  }
};

/// The places of a model that positions mean. Keeps references to model and surface.
class PlacesOnModel {
 public:
  PlacesOnModel(const Model& model, const Surface& surface);

  /// Of the model's box; 0 without vertices.
  [[nodiscard]] double diagonal() const { return diagonal_; }
  [[nodiscard]] double distance(std::uint32_t vertex, const glm::dvec3& position) const;

  /// The file vertex within 1e-4 of the diagonal: room for positions printed with few digits. Of several, one on the
  /// own side, then one of the part with the most vertices, then the nearest of that part.
  [[nodiscard]] std::optional<std::uint32_t> vertex_at(const glm::dvec3& position,
                                                       const OwnSide* own_side = nullptr) const;

  /// The point at the place of the surface nearest to `position`: at a vertex if one is meant, else between vertices.
  /// Of places equally near, that of the part with the most vertices. With a side, not on a triangle that is certainly
  /// on the other side. Empty: no place within 5 % of the diagonal.
  [[nodiscard]] std::optional<FeaturePoint> nearest_place(FeaturePointId id, const glm::dvec3& position,
                                                          const OwnSide* own_side) const;

  [[nodiscard]] FeaturePoint at_vertex(FeaturePointId id, std::uint32_t vertex) const {
    return {id, VertexId(vertex), model_.positions[vertex]};
  }

 private:
  /// A point found by position must not get a vertex without triangles.
  [[nodiscard]] bool is_used(std::uint32_t vertex) const;
  [[nodiscard]] glm::dvec3 at(std::uint32_t vertex) const { return glm::dvec3(model_.positions[vertex]); }
  [[nodiscard]] glm::dvec3 position_of(const TrianglePlace& place) const;
  [[nodiscard]] std::optional<TrianglePlace> nearest_on_triangles(const glm::dvec3& position,
                                                                  const OwnSide* own_side) const;

  const Model& model_;
  const Surface& surface_;
  double diagonal_ = 0.0;
};

}  // namespace semblante
