#pragma once

#include "core/types/feature_point_id.h"

namespace semblante {

/// A feature point that follows another one.
struct Companion {
  FeaturePointId point;
  FeaturePointId leader;
  float share = 0.0F;      ///< of the leader's displacement
  bool is_choice = false;  ///< of the lower lip with the jaw: only if the player chooses so
};

}  // namespace semblante
