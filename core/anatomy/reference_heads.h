#pragma once

#include <optional>
#include <span>
#include <string_view>

#include <glm/vec3.hpp>

#include "core/geometry/similarity.h"
#include "core/types/feature_point_id.h"
#include "core/types/places.h"

namespace semblante {

/// Measured positions of the feature points of one head: origin half way between the pupils, unit ES0, axes of MPEG-4.
/// Symmetric: the mean of the head and its mirror image. Points without a surface in the head's model
/// are missing.
struct ReferenceHead {
  std::string_view name;
  Places points;  ///< by FeaturePointId
};

/// The reference heads. README.md lists their sources.
std::span<const ReferenceHead> reference_heads();

/// The similarity from the known points of a face, in any axes, to those of a reference head, by the mean of
/// `references`. Empty if the points do not determine it.
std::optional<Similarity> fit_to_references(const Places& known,
                                            std::span<const ReferenceHead> references = reference_heads());

/// The mean of each point over the references that have it.
Places mean_of(std::span<const ReferenceHead> references);

}  // namespace semblante
