#pragma once

#include <cstdint>
#include <optional>

#include <glm/vec3.hpp>

#include "core/types/feature_point_id.h"

namespace semblante {

/// A feature point as marked by a person or a file, before it is matched with the model: a file vertex, a position or
/// both. parametrize/place_feature_points converts it to a FeaturePoint or returns an error.
struct MarkedPoint {
  FeaturePointId id;
  std::optional<std::uint32_t> vertex;  ///< file vertex, not checked against the model
  std::optional<glm::dvec3> position;   ///< model units, MPEG-4 frame
  bool proposed = false;                ///< a proposal that no person has confirmed
};

}  // namespace semblante
