#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "core/listen/sound_features.h"

namespace semblante {

/// From what is heard to the visemes of MPEG-4: a layer over three frames, gated recurrent units (Cho et al., "Learning
/// phrase representations using RNN encoder-decoder", 2014; the reset gate after the product), a layer. The weights
/// (generated/viseme_network_weights.h) have 8 bits, with a scale for each output.
class VisemeNetwork {
 public:
  static constexpr std::size_t visemes = 15;
  /// The answer to a frame is of the sound this many frames before: it has heard what comes after it.
  static constexpr std::size_t look_ahead = 4;

  /// The probability of each viseme; the sum is 1.
  std::array<float, visemes> step(std::span<const float, SoundFeatures::count> features);

  static constexpr std::size_t stacked = 3, units = 64;

 private:
  std::array<float, stacked * SoundFeatures::count> input_{};  ///< the newest frames, oldest first
  std::array<float, units> state_{};
};

}  // namespace semblante
