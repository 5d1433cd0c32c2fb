#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "core/listen/sound_features.h"
#include "core/listen/viseme_network.h"

namespace semblante {

/// Hears visemes in speech of any language, while it goes on. 10 ms of sound take about 0.1 ms; no memory is taken
/// after the constructor.
class VisemeListener {
 public:
  static constexpr std::uint32_t least_rate = 8'000, most_rate = 192'000;
  static constexpr double step_ms = SoundFeatures::step_ms;
  /// From a moment of the sound to the last sample that is heard for it: the frames after it, and half a window.
  static constexpr double delay_ms =
      step_ms * static_cast<double>(VisemeNetwork::look_ahead) + 0.5 * SoundFeatures::window_ms;

  struct Heard {
    double time;                                            ///< ms of the sound: the middle of 10 ms
    std::array<float, VisemeNetwork::visemes> probability;  ///< of each viseme of MPEG-4; the sum is 1
    float level;                                            ///< dB of full scale
  };

  /// `sample_rate`: from least_rate to most_rate, Hz.
  explicit VisemeListener(std::uint32_t sample_rate) : features_(sample_rate) {}

  /// Takes samples until something has been heard; `taken` of them. Full scale is 1; what is not finite is 0.
  std::optional<Heard> push(std::span<const float> samples, std::size_t& taken);

 private:
  SoundFeatures features_;
  VisemeNetwork network_;
  std::array<float, VisemeNetwork::look_ahead + 1> levels_{};
  std::size_t frames_ = 0;
};

}  // namespace semblante
