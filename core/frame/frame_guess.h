#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "core/frame/frame.h"
#include "core/geometry/surface.h"
#include "core/types/feature_point_id.h"
#include "core/types/model.h"

namespace semblante {

/// How a head stands and what its unit is, as far as can be told, and what told it.
struct ModelFrame {
  Axes axes;
  bool axes_sure = false;
  LengthUnit unit = LengthUnit::metre;
  bool unit_sure = false;
  std::vector<std::string> reasons;  ///< sentences for people: what was seen, and what follows from it

  bool operator==(const ModelFrame&) const = default;
};

/// What a user says about it; what is empty is guessed.
struct FrameWish {
  std::optional<LengthUnit> unit;
  std::optional<Direction> up, front;  ///< not on one axis

  [[nodiscard]] bool has_axes() const { return up || front; }
  bool operator==(const FrameWish&) const = default;
};

/// `guess` with what the user says in its place. Where only one of up and front is said, the other is the guess's if it
/// fits, else that of the least turn: a head that stands along +Z faces -Y.
ModelFrame apply_wish(ModelFrame guess, const FrameWish& wish);

/// A marked point and where it is in the file.
struct PlacedPoint {
  FeaturePointId id;
  glm::dvec3 position;
};

/// From the file alone: left and right by the plane of symmetry, the rest by eyes, mouth and neck, as far as parts show
/// them; the unit by the size a head, a bust or a body has. `model` as it lies in the file, `surface` its surface.
/// Where the axes are not sure they are MPEG-4's, which is how glTF asks a model to stand, and how most files do.
ModelFrame guess_frame(const Model& model, const Surface& surface);

/// From marked points, which decide more surely: left from pairs, up from eyes over mouth over chin, front from the
/// nose before the ears, the unit from the distance of the eyes. What the points do not say for sure is as it was
/// `before`. Points whose left and right contradict the rest are said to, and not believed in that.
ModelFrame guess_frame(std::span<const PlacedPoint> points, const ModelFrame& before);

}  // namespace semblante
