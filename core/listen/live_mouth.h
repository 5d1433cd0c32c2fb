#pragma once

#include <array>

#include "core/listen/viseme_listener.h"

namespace semblante {

/// What a mouth shows of what is heard, while it goes on: the probabilities without their flicker, vowels opened by
/// their loudness.
class LiveMouth {
 public:
  /// Weights of the visemes. Their sum is 1; the weight of silence is 1 minus the others.
  using Weights = std::array<float, VisemeNetwork::visemes>;
  const Weights& follow(const VisemeListener::Heard& heard);

  /// How far the weights are behind the probabilities, ms: lips close at once.
  static constexpr double delay_ms = 7.5;

 private:
  Weights weights_{1.0F};
  std::array<float, VisemeNetwork::visemes> likely_{1.0F};
  float usual_ = 0.0F;  ///< level of loud vowels so far, dB; 0: none was heard
};

}  // namespace semblante
