#pragma once

#include <cstdint>
#include <vector>

#include "deploy/sample_head/sample_head.h"

namespace semblante::testing {

/// The family's body with morph targets as avatars have them: the visemes of Oculus (viseme_aa, ...; all but silence)
/// and some shapes of ARKit (jawOpen, eyeBlinkLeft, ...), each the displacement that this project gives the head for
/// that viseme or coefficient. Made once.
const SampleHead& sample_avatar();

/// Its file, with the skeleton and the targets.
const std::vector<std::uint8_t>& sample_avatar_glb();

}  // namespace semblante::testing
