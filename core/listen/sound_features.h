#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/listen/mel_spectrum.h"

namespace semblante {

/// What is heard of a sound every `step_ms`, while it goes on: the level in bands of the mel scale, independent of the
/// gain and the colour of microphone, room and voice. Levels are relative to a slow follower of the peaks; from each
/// band its mean over the loud frames so far is taken, which begins at that of usual speech.
class SoundFeatures {
 public:
  static constexpr double step_ms = 10.0, window_ms = 25.0;
  static constexpr std::size_t bands = 24, count = bands + 1;
  struct Frame {
    std::array<float, count> features;  ///< of the bands, then of all; units of 20 dB
    double time;                        ///< ms: the middle of its window
    double level;                       ///< dB of full scale
  };

  explicit SoundFeatures(std::uint32_t sample_rate);

  /// Takes samples until the next frame is whole; `taken` of them. Full scale is 1; what is not finite is 0.
  std::optional<Frame> push(std::span<const float> samples, std::size_t& taken);

 private:
  [[nodiscard]] std::int64_t first_sample(std::int64_t frame) const;
  Frame frame();
  double per_ms_;
  MelSpectrum spectrum_;
  double full_scale_;           ///< power of a sine of full scale
  std::vector<double> window_;  ///< the newest samples, oldest first
  std::int64_t heard_ = 0;      ///< samples so far
  std::int64_t frames_ = 0;
  double peak_;  ///< dB
  std::array<double, bands> colour_;
  double loud_frames_;  ///< that `colour_` is the mean of
};

}  // namespace semblante
