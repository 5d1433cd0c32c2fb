#include "core/speech/cepstra.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <complex>
#include <numbers>

namespace semblante {
namespace {

constexpr std::size_t filters = 26;
constexpr double lowest_hz = 100.0;
constexpr double pre_emphasis = 0.97;
constexpr double least_power = 1e-10;

double mel_of(double hz) { return 2595.0 * std::log10(1.0 + hz / 700.0); }
double hz_of(double mel) { return 700.0 * (std::pow(10.0, mel / 2595.0) - 1.0); }

/// Discrete Fourier transform in place, of a size that is a power of two (Cooley and Tukey, 1965).
void transform(std::vector<std::complex<double>>& values, const std::vector<std::complex<double>>& roots) {
  const std::size_t size = values.size();
  for (std::size_t i = 1, j = 0; i < size; ++i) {  // order of reversed bits
    std::size_t bit = size >> 1U;
    for (; (j & bit) != 0; bit >>= 1U) j ^= bit;
    j ^= bit;
    if (i < j) std::swap(values[i], values[j]);
  }
  for (std::size_t half = 1; half < size; half *= 2)
    for (std::size_t first = 0; first < size; first += 2 * half)
      for (std::size_t k = 0; k < half; ++k) {
        const auto other = values[first + half + k] * roots[k * (size / (2 * half))];
        values[first + half + k] = values[first + k] - other;
        values[first + k] += other;
      }
}

/// A triangle of the filter bank, as weights of lines of the spectrum.
struct Filter {
  std::size_t first = 0;
  std::vector<double> weights;
};

std::vector<Filter> filter_bank(std::size_t transform_size, double sample_rate, double highest_hz) {
  std::array<double, filters + 2> corners{};
  const double lowest = mel_of(lowest_hz), highest = mel_of(highest_hz);
  for (std::size_t i = 0; i < corners.size(); ++i)
    corners[i] = hz_of(lowest + (highest - lowest) * static_cast<double>(i) / (filters + 1));
  std::vector<Filter> bank(filters);
  const double line_hz = sample_rate / static_cast<double>(transform_size);
  for (std::size_t f = 0; f < filters; ++f) {
    bank[f].first = static_cast<std::size_t>(std::ceil(corners[f] / line_hz));
    const auto last = std::min(transform_size / 2, static_cast<std::size_t>(corners[f + 2] / line_hz));
    for (std::size_t line = bank[f].first; line <= last; ++line) {
      const double hz = static_cast<double>(line) * line_hz;
      bank[f].weights.push_back(std::max(0.0, std::min((hz - corners[f]) / (corners[f + 1] - corners[f]),
                                                       (corners[f + 2] - hz) / (corners[f + 2] - corners[f + 1]))));
    }
  }
  return bank;
}

}  // namespace

Cepstra::Cepstra(std::span<const std::int16_t> samples, std::uint32_t sample_rate, double highest_hz) {
  using std::numbers::pi;
  const double per_ms = sample_rate / 1000.0;
  const auto window = static_cast<std::size_t>(window_ms * per_ms);
  const std::size_t size = std::bit_ceil(window);
  std::vector<std::complex<double>> roots(size / 2), values(size);
  for (std::size_t k = 0; k < roots.size(); ++k)
    roots[k] = std::polar(1.0, -2.0 * pi * static_cast<double>(k) / static_cast<double>(size));
  std::vector<double> hamming(window);
  for (std::size_t i = 0; i < window; ++i)
    hamming[i] = 0.54 - 0.46 * std::cos(2.0 * pi * static_cast<double>(i) / static_cast<double>(window - 1));
  const auto bank = filter_bank(size, sample_rate, std::min(highest_hz, sample_rate / 2.0));
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
    std::fill(values.begin(), values.end(), 0.0);
    for (std::size_t i = 0; i < window; ++i) {
      const std::ptrdiff_t at = first + static_cast<std::ptrdiff_t>(i);
      const double value = sample(at);
      power += value * value;
      values[i] = hamming[i] * (value - pre_emphasis * sample(at - 1));
    }
    transform(values, roots);
    std::array<double, filters> bands{};
    for (std::size_t f = 0; f < filters; ++f) {
      double sum = least_power;
      for (std::size_t i = 0; i < bank[f].weights.size(); ++i)
        sum += bank[f].weights[i] * std::norm(values[bank[f].first + i]);
      bands[f] = std::log(sum);
    }
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
