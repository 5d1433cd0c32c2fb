#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "core/frame/frame.h"
#include "core/geometry/surface.h"
#include "core/types/feature_point_id.h"
#include "core/types/model.h"

namespace semblante {

/// The axes and unit of a head with their certainty and reasons.
struct ModelFrame {
  Axes axes;
  bool axes_sure = false;
  LengthUnit unit = LengthUnit::metre;
  bool unit_sure = false;
  std::vector<std::string> reasons;  ///< sentences for people: what was seen, and what follows from it
  /// The rotation that turns the head upright after `axes`, of a head that is tilted in its file. Only points show it.
  glm::dmat3 tilt{1.0};

  bool operator==(const ModelFrame&) const = default;
};

/// MPEG-4 position = matrix * file position.
glm::dmat3 turn_upright(const ModelFrame& frame);

/// The angle of `tilt`, degrees.
double tilt_of(const ModelFrame& frame);

/// The user's settings; empty members are guessed.
struct FrameWish {
  std::optional<LengthUnit> unit;
  std::optional<Direction> up, front;  ///< not on one axis

  [[nodiscard]] bool has_axes() const { return up || front; }
  bool operator==(const FrameWish&) const = default;
};

/// `guess` with the user's settings applied. If only one of up and front is set, the other is the guess's if valid,
/// else that of the smallest rotation: a head with up +Z has front -Y. Axes set by the user are the head's own: it has
/// no tilt then.
ModelFrame apply_wish(ModelFrame guess, const FrameWish& wish);

/// A marked point with its position in the file.
struct PlacedPoint {
  FeaturePointId id;
  glm::dvec3 position;
};

/// Guesses from the file only: left and right by the plane of symmetry, the other axes by eyes, mouth and neck, if
/// parts show them; the unit by the size of a head, a bust or a body. `model` is in the file's axes, `surface` its
/// surface. Uncertain axes are set to MPEG-4's, which are also those of glTF and of most files, unless what was
/// seen rules them out.
ModelFrame guess_frame(const Model& model, const Surface& surface);

/// Guesses from marked points, which are more reliable: left from pairs, up from eyes above mouth above chin, front
/// from nose before ears, the tilt from the proportions of a face (face_tilt.h of anatomy), the unit from the eye
/// distance. A face that `before` turns upright already keeps its tilt. Members that the points do not determine keep
/// the value in `before`. If left and right contradict the other evidence, they are ignored, with a reason.
ModelFrame guess_frame(std::span<const PlacedPoint> points, const ModelFrame& before);

}  // namespace semblante
