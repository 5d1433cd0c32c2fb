#include "core/listen/sound_features.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace semblante {
namespace {

constexpr double lowest_hz = 100.0, highest_hz = 7000.0;
constexpr double least_power = 1e-10;
// The follower of the peaks, dB: a share of the way up each frame, and a slow fall. Below `least_peak` is no speech, so
// noise in a pause is not amplified further.
constexpr double attack = 0.3, fall = 0.03, least_peak = -55.0;
constexpr double loud_range = 25.0;  ///< dB below the peak: frames whose colour counts
// The mean colour knows this many frames of usual speech beforehand, and forgets after this many.
constexpr double known_frames = 60.0, most_frames = 500.0;
/// Of usual speech: a line over the bands, dB relative to the whole frame.
constexpr double first_band = -8.0, band_slope = -0.85;
constexpr double least_band = -65.0, most_band = 25.0, unit = 20.0;  // dB

double decibels(double power) { return 10.0 / std::numbers::ln10 * std::log(power + least_power); }

}  // namespace

SoundFeatures::SoundFeatures(std::uint32_t sample_rate)
    : per_ms_(sample_rate / 1000.0),
      spectrum_(sample_rate,
                {.filters = bands, .lowest_hz = lowest_hz, .highest_hz = highest_hz, .window_ms = window_ms}),
      // The mean of Hamming's window is 0.54; a sine has half of its amplitude at its line.
      full_scale_(0.27 * static_cast<double>(spectrum_.window()) * 0.27 * static_cast<double>(spectrum_.window())),
      window_(spectrum_.window() + 1, 0.0),
      peak_(least_peak),
      loud_frames_(known_frames) {
  for (std::size_t b = 0; b < bands; ++b) colour_[b] = first_band + band_slope * static_cast<double>(b);
}

std::int64_t SoundFeatures::first_sample(std::int64_t frame) const {
  return static_cast<std::int64_t>((static_cast<double>(frame) + 0.5) * step_ms * per_ms_) -
         static_cast<std::int64_t>(spectrum_.window() / 2);
}

std::optional<SoundFeatures::Frame> SoundFeatures::push(std::span<const float> samples, std::size_t& taken) {
  const std::int64_t wanted = first_sample(frames_) + static_cast<std::int64_t>(spectrum_.window()) - heard_;
  taken = std::min(samples.size(), static_cast<std::size_t>(std::max<std::int64_t>(0, wanted)));
  // Of more samples than a window holds only the last ones stay.
  const std::size_t kept = std::min(taken, window_.size());
  std::move(window_.begin() + static_cast<std::ptrdiff_t>(kept), window_.end(), window_.begin());
  for (std::size_t i = 0; i < kept; ++i) {
    const float value = samples[taken - kept + i];
    window_[window_.size() - kept + i] = std::isfinite(value) ? std::clamp(static_cast<double>(value), -8.0, 8.0) : 0.0;
  }
  heard_ += static_cast<std::int64_t>(taken);
  if (static_cast<std::int64_t>(taken) < wanted) return {};
  return frame();
}

SoundFeatures::Frame SoundFeatures::frame() {
  std::array<double, bands> level{};
  spectrum_.analyse(window_, level);
  double whole = 0.0;
  for (double& band : level) {
    whole += band;
    band = decibels(band / full_scale_);
  }
  Frame frame{};
  frame.time = (static_cast<double>(frames_) + 0.5) * step_ms;
  frame.level = decibels(whole / full_scale_);
  ++frames_;

  peak_ = frame.level > peak_ ? peak_ + attack * (frame.level - peak_) : std::max(least_peak, peak_ - fall);
  if (frame.level > peak_ - loud_range && frame.level > least_peak) {
    loud_frames_ = std::min(most_frames, loud_frames_ + 1.0);
    for (std::size_t b = 0; b < bands; ++b) {
      // A band in which the microphone hears nothing is no colour of a voice.
      const double heard = std::max(level[b] - frame.level, least_band);
      colour_[b] += (heard - colour_[b]) / loud_frames_;
    }
  }
  for (std::size_t b = 0; b < bands; ++b)
    frame.features[b] = static_cast<float>(std::clamp(level[b] - peak_ - colour_[b], least_band, most_band) / unit);
  frame.features[bands] = static_cast<float>(std::clamp(frame.level - peak_, least_band, most_band) / unit);
  return frame;
}

}  // namespace semblante
