#include "core/speech/cepstra.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/listen/mel_spectrum.h"

namespace semblante {
namespace {

constexpr std::size_t filters = 26;
constexpr double lowest_hz = 100.0;
constexpr double pre_emphasis = 0.97;
constexpr double least_power = 1e-10;

}  // namespace

Cepstra::Cepstra(std::span<const std::int16_t> samples, std::uint32_t sample_rate, double highest_hz) {
  using std::numbers::pi;
  const double per_ms = sample_rate / 1000.0;
  MelSpectrum spectrum(sample_rate, {.filters = filters,
                                     .lowest_hz = lowest_hz,
                                     .highest_hz = std::min(highest_hz, sample_rate / 2.0),
                                     .window_ms = window_ms,
                                     .pre_emphasis = pre_emphasis});
  const std::size_t window = spectrum.window();
  std::vector<double> values(window + 1);
  std::array<std::array<double, filters>, coefficients - 1> cosines{};
  for (std::size_t c = 0; c < cosines.size(); ++c)
    for (std::size_t f = 0; f < filters; ++f)
      cosines[c][f] = std::sqrt(2.0 / filters) *
                      std::cos(pi * static_cast<double>(c + 1) * (static_cast<double>(f) + 0.5) / filters);

  const auto count = static_cast<std::size_t>(static_cast<double>(samples.size()) / per_ms / step_ms);
  const auto sample = [&](std::ptrdiff_t at) {
    return at < 0 || at >= std::ssize(samples) ? 0.0 : samples[static_cast<std::size_t>(at)] / 32768.0;
  };
  frames_.resize(count);
  levels_.resize(count);
  for (std::size_t n = 0; n < count; ++n) {
    const auto first = static_cast<std::ptrdiff_t>((static_cast<double>(n) + 0.5) * step_ms * per_ms) -
                       static_cast<std::ptrdiff_t>(window / 2);
    double power = 0.0;
    for (std::size_t i = 0; i <= window; ++i) {
      values[i] = sample(first + static_cast<std::ptrdiff_t>(i) - 1);
      if (i > 0) power += values[i] * values[i];
    }
    std::array<double, filters> bands{};
    spectrum.analyse(values, bands);
    for (double& band : bands) band = std::log(band + least_power);
    for (std::size_t c = 0; c < cosines.size(); ++c) {
      double sum = 0.0;
      for (std::size_t f = 0; f < filters; ++f) sum += cosines[c][f] * bands[f];
      frames_[n][c] = static_cast<float>(sum);
    }
    const double level = 10.0 * std::log10(power / static_cast<double>(window) + least_power);
    levels_[n] = static_cast<float>(level);
    frames_[n].back() = static_cast<float>(level);
  }
}

}  // namespace semblante
