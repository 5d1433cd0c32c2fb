#pragma once

#include <complex>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace semblante {

struct MelOptions {
  std::size_t filters = 0;
  double lowest_hz = 0.0, highest_hz = 0.0;  ///< at most half of the sample rate is used
  double window_ms = 25.0;
  double pre_emphasis = 0.0;  ///< 0 to 1: y[i] = x[i] - pre_emphasis x[i-1]
};

/// The power of a window of sound in triangles that overlap by half and are equally wide on the mel scale (Davis and
/// Mermelstein, "Comparison of parametric representations for monosyllabic word recognition", 1980).
class MelSpectrum {
 public:
  MelSpectrum(std::uint32_t sample_rate, const MelOptions& options);

  [[nodiscard]] std::size_t window() const { return hamming_.size(); }  ///< samples
  /// `samples`: the one before the window, then those of the window; full scale is 1. `powers`: of each filter, the sum
  /// of the squared magnitudes of the Fourier transform, weighted by the triangle; 0 above half of the sample rate.
  void analyse(std::span<const double> samples, std::span<double> powers);

 private:
  /// A triangle, as weights of lines of the spectrum.
  struct Filter {
    std::size_t first = 0;
    std::vector<double> weights;
  };
  double pre_emphasis_;
  std::vector<double> hamming_;
  std::vector<std::complex<double>> roots_, values_;
  std::vector<Filter> bank_;
};

}  // namespace semblante
