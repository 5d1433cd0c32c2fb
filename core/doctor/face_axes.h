#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

#include "core/anatomy/point_symmetry.h"
#include "core/types/feature_points.h"
#include "core/types/places.h"

namespace semblante {

/// The axes of a face by its marked points, and the points' coordinates in these axes. Points with exchanged left and
/// right are corrected here, so that one fault does not cause twenty findings.
struct FaceAxes {
  /// Unit vectors in model space: to the face's left, up, and out of the face; right-handed.
  glm::dvec3 left{1, 0, 0}, up{0, 1, 0}, forward{0, 0, 1};
  /// Pairs with exchanged left and right, by their left points.
  std::vector<FeaturePointId> swapped;
  /// Distance between the pupils (ES0), model units: the median of several estimates, robust against one misplaced
  /// point. Empty with too few points around the eyes.
  std::optional<double> eye_separation;
  /// Every marked point: x along the model axis nearest to `left`, y to `up`, z to `forward`; model units.
  Places places;

  /// The plane of symmetry of `places`, if they have one.
  std::optional<PointSymmetry> symmetry;

  [[nodiscard]] const std::optional<glm::dvec3>& place(FeaturePointId id) const { return places[id.value()]; }
  /// `name` must be one of the 84.
  [[nodiscard]] const std::optional<glm::dvec3>& place(std::string_view name) const;
};

/// Axes without enough points are those of the model.
FaceAxes fit_face_axes(const FeaturePointSet& points);

}  // namespace semblante
