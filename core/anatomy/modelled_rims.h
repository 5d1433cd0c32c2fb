#pragma once

#include <optional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "core/anatomy/eye_skin.h"
#include "core/geometry/surface.h"
#include "core/types/model.h"

namespace semblante {

/// The edges of the lids about an eye that is modelled in the skin, as they are seen from the front.
struct ModelledRims {
  /// Where the eye ends at one x.
  struct Column {
    glm::dvec3 upper, lower;
  };
  std::vector<Column> columns;          ///< evenly spaced, x rising
  glm::dvec3 left{0.0}, right{0.0};     ///< the corners, as the face has them
  std::vector<SurfaceVertexId> of_eye;  ///< where no point of the lids is: the eye, and what lies on its ball; rising

  [[nodiscard]] const Column& at(double x) const;
  [[nodiscard]] bool is_of_eye(SurfaceVertexId vertex) const;
  /// Whether a place is between the edges, seen from the front.
  [[nodiscard]] bool surround(const glm::dvec3& place) const;
};

/// The edges of an eye that is about between `expected`: a smooth patch with lids that step forward all around it.
/// `places` are those of the vertices of `surface` in the frame of `expected`, an upright face; `triangles` are of file
/// vertices. Empty without such a patch, or if it is not about where the eye is expected.
std::optional<ModelledRims> find_modelled_rims(const Surface& surface, std::span<const glm::dvec3> places,
                                               std::span<const Triangle> triangles, PartId part,
                                               const LidPlaces& expected);

}  // namespace semblante
