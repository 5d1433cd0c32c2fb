#include "server/voice/sound_coder.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <opus.h>
#include <string>
#include <utility>

#include "core/speech/utterance.h"
#include "server/voice/resample.h"

namespace semblante::voice {
namespace {

/// Speech has little above 12 kHz; the voice of espeak-ng ends at 11.
constexpr opus_int32 coded_rate = 24'000;
constexpr std::size_t samples_per_ms = coded_rate / 1000;
/// How long a packet may be (RFC 6716, 2.1.4), ms; the short ones for the end of a part.
constexpr auto packet_lengths = std::to_array<std::size_t>({static_cast<std::size_t>(packet_ms), 40, 20, 10});
constexpr std::size_t least_packet = packet_lengths.back() * samples_per_ms;
/// The greatest packet of one channel that the encoder is allowed.
constexpr opus_int32 max_packet_bytes = 1'275;
/// Of 0 to 10. Takes 0.6 of the time of 9, the library's own choice, for as many bytes.
constexpr opus_int32 complexity = 5;
/// Opus says by packets of one or two bytes that nothing is to be heard (DTX).
constexpr opus_int32 silent_bytes = 2;

Error library_error(const char* text) { return {ErrorCode::internal, "", text}; }

}  // namespace

Result<SoundCoder> SoundCoder::make() {
  int error = OPUS_OK;
  Encoder encoder(opus_encoder_create(coded_rate, 1, OPUS_APPLICATION_VOIP, &error), opus_encoder_destroy);
  if (!encoder) return library_error(opus_strerror(error));
  opus_int32 delay = 0;
  for (const int result : {opus_encoder_ctl(encoder.get(), OPUS_SET_BITRATE(static_cast<opus_int32>(packet_bitrate))),
                           opus_encoder_ctl(encoder.get(), OPUS_SET_SIGNAL(OPUS_SIGNAL_VOICE)),
                           opus_encoder_ctl(encoder.get(), OPUS_SET_DTX(1)),
                           opus_encoder_ctl(encoder.get(), OPUS_SET_COMPLEXITY(complexity)),
                           opus_encoder_ctl(encoder.get(), OPUS_GET_LOOKAHEAD(&delay))})
    if (result != OPUS_OK) return library_error(opus_strerror(result));
  return SoundCoder(std::move(encoder), static_cast<std::size_t>(delay));
}

double SoundCoder::end() const {
  return static_cast<double>(begin_ + waiting_.size() + delay_ - cut_) / samples_per_ms;
}

Status SoundCoder::add(std::span<const std::int16_t> samples, std::uint32_t sample_rate) {
  if (sample_rate < least_sample_rate || sample_rate > most_sample_rate)
    return Error{ErrorCode::out_of_range, "", std::to_string(sample_rate) + " samples a second"};
  auto sound = resampled(samples, sample_rate, coded_rate);
  if (!sound) return sound.error();
  begin_ += coded_;
  waiting_.erase(waiting_.begin(), waiting_.begin() + static_cast<std::ptrdiff_t>(std::exchange(coded_, 0)));
  // What the decoder gives is late by the coder's delay: begun that much later, the sound is in time.
  const auto cut = std::min(cut_, sound->size());
  cut_ -= cut;
  waiting_.insert(waiting_.end(), sound->begin() + static_cast<std::ptrdiff_t>(cut), sound->end());
  waiting_.resize((waiting_.size() + least_packet - 1) / least_packet * least_packet, 0.0F);
  return Unit{};
}

void SoundCoder::pause(double ms) {
  assert(coded_ == 0);
  const auto samples = static_cast<std::size_t>(std::lround(ms)) * samples_per_ms;
  assert(samples % least_packet == 0);
  begin_ += samples;
}

Result<std::vector<CodedSound>> SoundCoder::code(double ms) {
  std::vector<CodedSound> coded;
  std::array<std::uint8_t, max_packet_bytes> packet{};
  const std::size_t until = std::min(waiting_.size(), coded_ + static_cast<std::size_t>(ms * samples_per_ms));
  while (coded_ < until) {
    const std::size_t left = waiting_.size() - coded_;
    const auto length = *std::find_if(packet_lengths.begin(), packet_lengths.end(),
                                      [left](std::size_t one) { return one * samples_per_ms <= left; });
    const opus_int32 size =
        opus_encode_float(encoder_.get(), waiting_.data() + coded_, static_cast<int>(length * samples_per_ms),
                          packet.data(), max_packet_bytes);
    if (size < 0) return library_error(opus_strerror(size));
    if (size > silent_bytes)
      coded.push_back({(begin_ + coded_) / samples_per_ms, {packet.begin(), packet.begin() + size}});
    coded_ += length * samples_per_ms;
  }
  return coded;
}

}  // namespace semblante::voice
