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
struct FrameGuess {
  Axes axes;
  bool axes_sure = false;
  LengthUnit unit = LengthUnit::metre;
  bool unit_sure = false;
  std::vector<std::string> reasons;  ///< sentences for people: what was seen, and what follows from it
};

/// A marked point and where it is in the file.
struct PlacedPoint {
  FeaturePointId id;
  glm::dvec3 position;
};

/// From the file alone: left and right by the plane of symmetry, the rest by eyes, mouth and neck, as far as parts show
/// them; the unit by the size a head, a bust or a body has. `model` as it lies in the file, `surface` its surface.
/// Where the axes are not sure they are MPEG-4's, which is how glTF asks a model to stand, and how most files do.
FrameGuess guess_frame(const Model& model, const Surface& surface);

/// From marked points, which decide more surely: left from pairs, up from eyes over mouth over chin, front from the
/// nose before the ears, the unit from the distance of the eyes. What the points do not say is taken from `before`.
/// Points whose left and right contradict the rest are said to, and not believed in that.
FrameGuess guess_frame(std::span<const PlacedPoint> points, const FrameGuess& before);

}  // namespace semblante
