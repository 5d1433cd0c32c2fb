#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

#include "core/types/feature_points.h"

namespace semblante {

/// Which way a face lies, by its marked points, and where they are in its own axes. Points whose left and right are
/// exchanged have been put right here, so that one fault does not show as twenty.
struct FaceFrame {
  /// Of the face: to its left, up, out of it; in model space, right-handed, unit length.
  glm::dvec3 left{1, 0, 0}, up{0, 1, 0}, forward{0, 0, 1};
  /// Pairs that are marked the wrong way round, as their points of the left side.
  std::vector<FeaturePointId> swapped;
  /// How far apart the pupils are, ES0, in model units: the middle one of several estimates, so that one misplaced
  /// point does not spoil it. Empty with too few points around the eyes.
  std::optional<double> eye_separation;
  /// Of every marked point: x along the model axis nearest to `left`, y to `up`, z to `forward`; model units.
  std::array<std::optional<glm::dvec3>, feature_point_count> places;

  [[nodiscard]] const std::optional<glm::dvec3>& place(FeaturePointId id) const { return places[id.value()]; }
  /// `name` must be one of the 84.
  [[nodiscard]] const std::optional<glm::dvec3>& place(std::string_view name) const;
};

/// Where too few points tell, the model's own axes stand in.
FaceFrame fit_face_frame(const FeaturePointSet& points);

}  // namespace semblante
