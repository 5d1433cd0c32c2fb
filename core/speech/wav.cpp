#include "core/speech/wav.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>

namespace semblante {
namespace {

// Format tags of RIFF (RFC 2361); `extensible` has its tag at the beginning of a GUID.
constexpr std::uint32_t pcm = 1, ieee_float = 3, extensible = 0xFFFE;
constexpr std::uint32_t most_channels = 8;

std::uint32_t number_at(std::string_view bytes, std::size_t at, std::size_t count) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < count; ++i)
    value |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[at + i])) << (8 * i);
  return value;
}

Error refused(ErrorCode code, std::size_t byte, std::string message) {
  return {code, "byte " + std::to_string(byte), std::move(message)};
}

struct Format {
  std::uint32_t tag = 0, channels = 0, rate = 0, bits = 0;
};

Result<Format> format_of(std::string_view chunk, std::size_t at) {
  if (chunk.size() < 16) return refused(ErrorCode::truncated, at, "the chunk \"fmt \" has fewer than 16 bytes");
  Format format{number_at(chunk, 0, 2), number_at(chunk, 2, 2), number_at(chunk, 4, 4), number_at(chunk, 14, 2)};
  if (format.tag == extensible && chunk.size() >= 26) format.tag = number_at(chunk, 24, 2);
  const bool whole = format.tag == pcm && format.bits % 8 == 0 && format.bits >= 8 && format.bits <= 32;
  if (!whole && !(format.tag == ieee_float && format.bits == 32))
    return refused(ErrorCode::unsupported, at, "the sound is neither PCM of 8 to 32 bits nor floats of 32");
  if (format.channels < 1 || format.channels > most_channels)
    return refused(ErrorCode::out_of_range, at, "the sound must have one to eight channels");
  if (format.rate < least_sample_rate || format.rate > most_sample_rate)
    return refused(ErrorCode::out_of_range, at,
                   "the sound must have " + std::to_string(least_sample_rate) + " to " +
                       std::to_string(most_sample_rate) + " samples a second");
  return format;
}

/// -1 to 1; 0 for a float that is no number.
double sample_at(std::string_view bytes, std::size_t at, const Format& format) {
  const std::uint32_t raw = number_at(bytes, at, format.bits / 8);
  if (format.tag == ieee_float) {
    const auto value = static_cast<double>(std::bit_cast<float>(raw));
    return std::isnan(value) ? 0.0 : std::clamp(value, -1.0, 1.0);
  }
  if (format.bits == 8) return (static_cast<double>(raw) - 128.0) / 128.0;  // the only one without a sign
  return static_cast<std::int32_t>(raw << (32 - format.bits)) / 2147483648.0;
}

Result<Recording> recording_of(std::string_view data, std::size_t at, const Format& format) {
  const std::size_t frame = std::size_t{format.channels} * (format.bits / 8);
  const std::size_t count = data.size() / frame;
  if (count == 0) return refused(ErrorCode::empty, at, "there is no sound");
  if (static_cast<double>(count) > max_speech_seconds * format.rate)
    return refused(ErrorCode::too_large, at,
                   "the sound is longer than " + std::to_string(static_cast<int>(max_speech_seconds)) + " s");
  Recording recording{format.rate, {}};
  recording.samples.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    double sum = 0.0;
    for (std::size_t channel = 0; channel < format.channels; ++channel)
      sum += sample_at(data, i * frame + channel * (format.bits / 8), format);
    recording.samples.push_back(
        static_cast<std::int16_t>(std::clamp(std::lround(sum / format.channels * 32768.0), -32768L, 32767L)));
  }
  return recording;
}

void append_number(std::string& bytes, std::uint32_t value, int count) {
  for (int i = 0; i < count; ++i) bytes += static_cast<char>(value >> (8 * i) & 0xFFU);
}

}  // namespace

Result<Recording> read_wav(std::string_view file) {
  if (file.size() < 12 || !file.starts_with("RIFF") || file.substr(8, 4) != "WAVE")
    return refused(ErrorCode::malformed, 0, "is no WAV file");
  std::optional<Format> format;
  for (std::size_t at = 12; at + 8 <= file.size();) {
    const std::string_view name = file.substr(at, 4);
    const std::size_t declared = number_at(file, at + 4, 4);
    const std::string_view chunk = file.substr(at + 8, declared);
    if (name == "fmt ") {
      const auto read = format_of(chunk, at);
      if (!read) return read.error();
      format = *read;
    } else if (name == "data") {
      if (!format) return refused(ErrorCode::missing, at, "the chunk \"fmt \" must come before \"data\"");
      return recording_of(chunk, at, *format);
    }
    at += 8 + declared + declared % 2;
  }
  return refused(ErrorCode::missing, file.size(), "has no chunk \"data\"");
}

std::string wav(const Utterance& utterance) {
  const auto size = static_cast<std::uint32_t>(utterance.samples.size() * 2);
  std::string bytes = "RIFF";
  append_number(bytes, 36 + size, 4);
  bytes += "WAVEfmt ";
  append_number(bytes, 16, 4);
  append_number(bytes, 1, 2);  // PCM
  append_number(bytes, 1, 2);  // channels
  append_number(bytes, utterance.sample_rate, 4);
  append_number(bytes, utterance.sample_rate * 2, 4);
  append_number(bytes, 2, 2);   // bytes of a frame
  append_number(bytes, 16, 2);  // bits of a sample
  bytes += "data";
  append_number(bytes, size, 4);
  bytes.reserve(bytes.size() + size);
  for (const std::int16_t sample : utterance.samples) append_number(bytes, static_cast<std::uint16_t>(sample), 2);
  return bytes;
}

}  // namespace semblante
