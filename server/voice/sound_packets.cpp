#include "server/voice/sound_packets.h"

#include <algorithm>
#include <array>
#include <memory>
#include <opus.h>
#include <samplerate.h>
#include <string>

#include "core/speech/utterance.h"

namespace semblante::voice {
namespace {

/// Speech has little above 12 kHz; the voice of espeak-ng ends at 11.
constexpr opus_int32 coded_rate = 24'000;
constexpr std::size_t packet_samples = static_cast<std::size_t>(coded_rate * packet_ms / 1000.0);
/// The greatest packet of one channel that the encoder is allowed.
constexpr opus_int32 max_packet_bytes = 1'275;
/// Of 0 to 10. Takes 0.6 of the time of 9, the library's own choice, for as many bytes.
constexpr opus_int32 complexity = 5;
/// Opus says by packets of one or two bytes that nothing is to be heard (DTX).
constexpr opus_int32 silent_bytes = 2;

using Encoder = std::unique_ptr<OpusEncoder, decltype(&opus_encoder_destroy)>;

Error library_error(const char* text) { return {ErrorCode::internal, "", text}; }

/// The samples at coded_rate, as floats within +-1.
Result<std::vector<float>> resampled(std::span<const std::int16_t> samples, std::uint32_t sample_rate) {
  std::vector<float> from(samples.size());
  src_short_to_float_array(samples.data(), from.data(), static_cast<int>(samples.size()));
  if (sample_rate == coded_rate) return from;
  SRC_DATA work{};
  work.src_ratio = static_cast<double>(coded_rate) / sample_rate;
  std::vector<float> to(static_cast<std::size_t>(static_cast<double>(from.size()) * work.src_ratio) + 1);
  work.data_in = from.data();
  work.input_frames = static_cast<long>(from.size());
  work.data_out = to.data();
  work.output_frames = static_cast<long>(to.size());
  if (const int error = src_simple(&work, SRC_SINC_FASTEST, 1); error != 0) return library_error(src_strerror(error));
  to.resize(static_cast<std::size_t>(work.output_frames_gen));
  return to;
}

}  // namespace

Result<std::vector<std::vector<std::uint8_t>>> sound_packets(std::span<const std::int16_t> samples,
                                                             std::uint32_t sample_rate) {
  if (sample_rate < least_sample_rate || sample_rate > most_sample_rate)
    return Error{ErrorCode::out_of_range, "", std::to_string(sample_rate) + " samples a second"};
  auto sound = resampled(samples, sample_rate);
  if (!sound) return sound.error();

  int error = OPUS_OK;
  const Encoder encoder(opus_encoder_create(coded_rate, 1, OPUS_APPLICATION_VOIP, &error), opus_encoder_destroy);
  if (!encoder) return library_error(opus_strerror(error));
  opus_int32 delay = 0;
  for (const int result : {opus_encoder_ctl(encoder.get(), OPUS_SET_BITRATE(static_cast<opus_int32>(packet_bitrate))),
                           opus_encoder_ctl(encoder.get(), OPUS_SET_SIGNAL(OPUS_SIGNAL_VOICE)),
                           opus_encoder_ctl(encoder.get(), OPUS_SET_DTX(1)),
                           opus_encoder_ctl(encoder.get(), OPUS_SET_COMPLEXITY(complexity)),
                           opus_encoder_ctl(encoder.get(), OPUS_GET_LOOKAHEAD(&delay))})
    if (result != OPUS_OK) return library_error(opus_strerror(result));

  // What the decoder gives is late by the coder's delay: begun that much later, the sound is in time.
  sound->erase(sound->begin(), sound->begin() + std::min<std::ptrdiff_t>(delay, std::ssize(*sound)));
  sound->resize((sound->size() + packet_samples - 1) / packet_samples * packet_samples, 0.0F);
  std::vector<std::vector<std::uint8_t>> packets;
  std::array<std::uint8_t, max_packet_bytes> packet{};
  for (std::size_t at = 0; at < sound->size(); at += packet_samples) {
    const opus_int32 size = opus_encode_float(encoder.get(), sound->data() + at, static_cast<int>(packet_samples),
                                              packet.data(), max_packet_bytes);
    if (size < 0) return library_error(opus_strerror(size));
    packets.emplace_back(packet.begin(), packet.begin() + (size <= silent_bytes ? 0 : size));
  }
  return packets;
}

}  // namespace semblante::voice
