#include "core/listen/mel_spectrum.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <numbers>
#include <utility>

namespace semblante {
namespace {

// Up to a factor, which does not matter here, the mel of O'Shaughnessy, 2595 log10(1 + hz / 700).
double mel_of(double hz) { return std::log(1.0 + hz / 700.0); }
double hz_of(double mel) { return 700.0 * (std::exp(mel) - 1.0); }

/// The plain product: operator* of std::complex is slower, because it handles infinite factors too.
std::complex<double> product(std::complex<double> a, std::complex<double> b) {
  return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}

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
        const auto other = product(values[first + half + k], roots[k * (size / (2 * half))]);
        values[first + half + k] = values[first + k] - other;
        values[first + k] += other;
      }
}

}  // namespace

MelSpectrum::MelSpectrum(std::uint32_t sample_rate, const MelOptions& options)
    : pre_emphasis_(options.pre_emphasis),
      hamming_(static_cast<std::size_t>(options.window_ms * (sample_rate / 1000.0))),
      bank_(options.filters) {
  using std::numbers::pi;
  const std::size_t window = hamming_.size(), size = std::bit_ceil(window);
  for (std::size_t i = 0; i < window; ++i)
    hamming_[i] = 0.54 - 0.46 * std::cos(2.0 * pi * static_cast<double>(i) / static_cast<double>(window - 1));
  values_.resize(size);
  roots_.resize(size / 2);
  for (std::size_t k = 0; k < roots_.size(); ++k) {
    const double angle = -2.0 * pi * static_cast<double>(k) / static_cast<double>(size);
    roots_[k] = {std::cos(angle), std::sin(angle)};
  }
  const double lowest = mel_of(options.lowest_hz), line_hz = sample_rate / static_cast<double>(size);
  const double width = (mel_of(options.highest_hz) - lowest) / static_cast<double>(options.filters + 1);
  const auto corner = [&](std::size_t i) { return hz_of(lowest + width * static_cast<double>(i)); };
  for (std::size_t f = 0; f < options.filters; ++f) {
    const double begin = corner(f), top = corner(f + 1), end = corner(f + 2);
    bank_[f].first = static_cast<std::size_t>(std::ceil(begin / line_hz));
    const auto last = std::min(size / 2, static_cast<std::size_t>(end / line_hz));
    for (std::size_t line = bank_[f].first; line <= last; ++line) {
      const double hz = static_cast<double>(line) * line_hz;
      bank_[f].weights.push_back(std::max(0.0, std::min((hz - begin) / (top - begin), (end - hz) / (end - top))));
    }
  }
}

void MelSpectrum::analyse(std::span<const double> samples, std::span<double> powers) {
  assert(samples.size() == window() + 1 && powers.size() == bank_.size());
  std::fill(values_.begin(), values_.end(), 0.0);
  for (std::size_t i = 0; i < window(); ++i) values_[i] = hamming_[i] * (samples[i + 1] - pre_emphasis_ * samples[i]);
  transform(values_, roots_);
  for (std::size_t f = 0; f < bank_.size(); ++f) {
    double sum = 0.0;
    for (std::size_t i = 0; i < bank_[f].weights.size(); ++i)
      sum += bank_[f].weights[i] * std::norm(values_[bank_[f].first + i]);
    powers[f] = sum;
  }
}

}  // namespace semblante
