#pragma once

#include <array>
#include <optional>
#include <span>

#include <glm/vec3.hpp>

#include "core/anatomy/reference_heads.h"
#include "core/geometry/similarity.h"
#include "core/propose/relations.h"
#include "core/types/feature_point_id.h"

namespace semblante {

struct KnownPlace {
  FeaturePointId id;
  glm::dvec3 place{0.0};
  double noise = 0.0;  ///< standard deviation, in ES0
};

struct Guess {
  glm::dvec3 place{0.0};
  double error = 0.0;  ///< expected error in ES0: the field's uncertainty and the differences between heads
};

/// Guesses every point by the proportions of the references, each deformed to the known places (ProportionField); the
/// median over the references. Empty for points without a reference. Positions in an upright frame of unit ES0.
std::array<std::optional<Guess>, feature_point_count> guess_by_proportions(std::span<const KnownPlace> known,
                                                                           std::span<const ReferenceHead> references);

}  // namespace semblante
