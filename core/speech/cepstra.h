#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace semblante {

/// The sound's spectrum over time as cepstra of the mel scale (Davis and Mermelstein, "Comparison of parametric
/// representations for monosyllabic word recognition", 1980): a frame every `step_ms`, of the sound `window_ms` long
/// around it.
class Cepstra {
 public:
  static constexpr double step_ms = 10.0, window_ms = 25.0;
  static constexpr std::size_t coefficients = 13;  ///< c1..c12 and the log energy
  using Frame = std::array<float, coefficients>;

  /// Of the frequencies below `highest_hz`, at most half of `sample_rate`.
  Cepstra(std::span<const std::int16_t> samples, std::uint32_t sample_rate, double highest_hz);

  [[nodiscard]] const std::vector<Frame>& frames() const { return frames_; }
  /// dB of full scale, of each frame.
  [[nodiscard]] const std::vector<float>& levels() const { return levels_; }

 private:
  std::vector<Frame> frames_;
  std::vector<float> levels_;
};

}  // namespace semblante
