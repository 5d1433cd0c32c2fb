#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>

#include <glm/vec3.hpp>

#include "core/types/feature_point_id.h"

namespace semblante {

/// Where the feature points of one head lie, as measured figures: the origin is half way between the pupils, one unit
/// is ES0, axes as MPEG-4's. Symmetric: the mean of a head and its mirror image. A head lacks the points that its model
/// has no surface for.
struct ReferenceHead {
  std::string_view name;
  std::array<std::optional<glm::dvec3>, feature_point_count> points;  ///< by FeaturePointId
};

/// What is known of the proportions of heads. README.md says where each comes from.
std::span<const ReferenceHead> reference_heads();

}  // namespace semblante
