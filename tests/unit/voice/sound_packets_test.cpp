#include "server/voice/sound_packets.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <opus.h>

#include <gtest/gtest.h>

namespace semblante::voice {
namespace {

constexpr std::size_t decoded_samples = 2'880;  ///< of a packet, at 48 kHz

/// A tone of 300 Hz whose loudness swells and fades three times a second, so that its delay can be seen.
std::vector<std::int16_t> swelling_tone(std::uint32_t rate, double seconds) {
  std::vector<std::int16_t> samples(static_cast<std::size_t>(rate * seconds));
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double t = static_cast<double>(i) / rate;
    const double loudness = std::pow(std::sin(std::numbers::pi * 3.0 * t), 2.0);
    samples[i] = static_cast<std::int16_t>(12'000.0 * loudness * std::sin(2.0 * std::numbers::pi * 300.0 * t));
  }
  return samples;
}

std::vector<float> decoded(const std::vector<std::vector<std::uint8_t>>& packets) {
  int error = 0;
  const std::unique_ptr<OpusDecoder, decltype(&opus_decoder_destroy)> decoder(opus_decoder_create(48'000, 1, &error),
                                                                              opus_decoder_destroy);
  EXPECT_EQ(error, OPUS_OK);
  std::vector<float> samples(packets.size() * decoded_samples, 0.0F);
  for (std::size_t i = 0; i < packets.size(); ++i) {
    if (packets[i].empty()) continue;
    const int count = opus_decode_float(decoder.get(), packets[i].data(), static_cast<opus_int32>(packets[i].size()),
                                        samples.data() + i * decoded_samples, static_cast<int>(decoded_samples), 0);
    EXPECT_EQ(count, static_cast<int>(decoded_samples)) << "packet " << i << " does not last 60 ms";
  }
  return samples;
}

/// Loudness in steps of 1 ms.
template <class Sample>
std::vector<double> envelope(const std::vector<Sample>& samples, double rate) {
  const double step = rate / 1000.0;
  std::vector<double> loudness(static_cast<std::size_t>(static_cast<double>(samples.size()) / step), 0.0);
  for (std::size_t ms = 0; ms < loudness.size(); ++ms)
    for (auto i = static_cast<std::size_t>(static_cast<double>(ms) * step);
         i < static_cast<std::size_t>(static_cast<double>(ms + 1) * step); ++i)
      loudness[ms] += std::abs(static_cast<double>(samples[i]));
  return loudness;
}

/// By how many ms `late` is behind `early`, of -40 to 40, where both agree best.
int lag(const std::vector<double>& early, const std::vector<double>& late) {
  int best = 0;
  double most = -1.0;
  for (int shift = -40; shift <= 40; ++shift) {
    double sum = 0.0;
    for (int i = 100; i + 100 < static_cast<int>(std::min(early.size(), late.size())); ++i)
      sum += early[static_cast<std::size_t>(i)] * late[static_cast<std::size_t>(i + shift)];
    if (sum > most) most = sum, best = shift;
  }
  return best;
}

TEST(SoundPackets, Decoded_IsInTime_AtEveryRate) {
  for (const std::uint32_t rate : {8'000U, 16'000U, 22'050U, 24'000U, 44'100U, 48'000U}) {
    const auto tone = swelling_tone(rate, 3.0);
    const auto packets = sound_packets(tone, rate);
    ASSERT_TRUE(packets) << packets.error().message;
    EXPECT_EQ(packets->size(), 50U);
    EXPECT_LE(std::abs(lag(envelope(tone, rate), envelope(decoded(*packets), 48'000.0))), 2) << rate;
  }
}

TEST(SoundPackets, Speech_TakesItsBitrate) {
  const auto packets = sound_packets(swelling_tone(24'000, 6.0), 24'000);
  ASSERT_TRUE(packets);
  double bits = 0.0;
  for (const auto& packet : *packets) bits += 8.0 * static_cast<double>(packet.size());
  EXPECT_LE(bits / 6.0, 24'000.0);
}

TEST(SoundPackets, Silence_IsNotSent) {
  const std::vector<std::int16_t> silence(24'000 * 6, 0);
  const auto packets = sound_packets(silence, 24'000);
  ASSERT_TRUE(packets);
  const auto sent = std::count_if(packets->begin(), packets->end(), [](const auto& packet) { return !packet.empty(); });
  EXPECT_LT(sent, 25) << "of 100";
}

TEST(SoundPackets, LessThanAPacket_IsOne) {
  const auto packets = sound_packets(swelling_tone(24'000, 0.02), 24'000);
  ASSERT_TRUE(packets);
  EXPECT_EQ(packets->size(), 1U);
  const auto nothing = sound_packets({}, 24'000);
  ASSERT_TRUE(nothing);
  EXPECT_TRUE(nothing->empty());
}

TEST(SoundPackets, RateOutOfRange_IsRefused) {
  for (const std::uint32_t rate : {0U, 7'999U, 48'001U}) {
    const auto packets = sound_packets(swelling_tone(8'000, 0.1), rate);
    ASSERT_FALSE(packets);
    EXPECT_EQ(packets.error().code, ErrorCode::out_of_range);
  }
}

}  // namespace
}  // namespace semblante::voice
