#include "server/voice/resample.h"

#include <algorithm>
#include <cmath>
#include <samplerate.h>

namespace semblante::voice {

Result<std::vector<float>> resampled(std::span<const std::int16_t> samples, std::uint32_t from, std::uint32_t to) {
  std::vector<float> in(samples.size());
  src_short_to_float_array(samples.data(), in.data(), static_cast<int>(samples.size()));
  if (from == to || samples.empty()) return in;
  SRC_DATA work{};
  work.src_ratio = static_cast<double>(to) / from;
  const double length = static_cast<double>(in.size()) * work.src_ratio;
  std::vector<float> out(static_cast<std::size_t>(length) + 1);
  work.data_in = in.data();
  work.input_frames = static_cast<long>(in.size());
  work.data_out = out.data();
  work.output_frames = static_cast<long>(out.size());
  if (const int error = src_simple(&work, SRC_SINC_FASTEST, 1); error != 0)
    return Error{ErrorCode::internal, "", src_strerror(error)};
  std::fill(out.begin() + work.output_frames_gen, out.end(), 0.0F);
  out.resize(static_cast<std::size_t>(std::lround(length)), 0.0F);
  return out;
}

Result<Recording> resampled(const Recording& sound, std::uint32_t to) {
  if (sound.sample_rate == to) return sound;
  const auto converted = resampled(sound.samples, sound.sample_rate, to);
  if (!converted) return converted.error();
  Recording recording{to, std::vector<std::int16_t>(converted->size())};
  src_float_to_short_array(converted->data(), recording.samples.data(), static_cast<int>(converted->size()));
  return recording;
}

}  // namespace semblante::voice
