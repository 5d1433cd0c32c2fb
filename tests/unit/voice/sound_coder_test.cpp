#include "server/voice/sound_coder.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <numeric>
#include <opus.h>

#include <gtest/gtest.h>

namespace semblante::voice {
namespace {

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

std::vector<CodedSound> all_of(SoundCoder& coder) {
  auto sound = coder.code(1e6);
  EXPECT_TRUE(sound) << sound.error().message;
  EXPECT_TRUE(coder.done());
  return *std::move(sound);
}

SoundCoder new_coder() {
  auto coder = SoundCoder::make();
  EXPECT_TRUE(coder) << coder.error().message;
  return *std::move(coder);
}

std::vector<CodedSound> coded(std::span<const std::int16_t> samples, std::uint32_t rate) {
  auto coder = new_coder();
  EXPECT_TRUE(coder.add(samples, rate));
  return all_of(coder);
}

/// At 48 kHz, silent where no packet is.
std::vector<float> decoded(const std::vector<CodedSound>& packets) {
  int error = 0;
  const std::unique_ptr<OpusDecoder, decltype(&opus_decoder_destroy)> decoder(opus_decoder_create(48'000, 1, &error),
                                                                              opus_decoder_destroy);
  EXPECT_EQ(error, OPUS_OK);
  std::vector<float> samples;
  for (const auto& [time, packet] : packets) {
    EXPECT_LE(samples.size(), time * 48U) << "packets overlap";
    samples.resize(time * 48U + 2'880U, 0.0F);
    const int count = opus_decode_float(decoder.get(), packet.data(), static_cast<opus_int32>(packet.size()),
                                        samples.data() + time * 48U, 2'880, 0);
    EXPECT_GT(count, 0);
    samples.resize(time * 48U + static_cast<std::size_t>(std::max(0, count)));
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

TEST(SoundCoder, Decoded_IsInTime_AtEveryRate) {
  for (const std::uint32_t rate : {8'000U, 16'000U, 22'050U, 24'000U, 44'100U, 48'000U}) {
    const auto tone = swelling_tone(rate, 3.0);
    const auto packets = coded(tone, rate);
    for (std::size_t i = 0; i < 49; ++i) EXPECT_EQ(packets[i].time, i * 60U);
    EXPECT_LE(std::abs(lag(envelope(tone, rate), envelope(decoded(packets), 48'000.0))), 2) << rate;
  }
}

TEST(SoundCoder, Parts_FollowEachOtherWithoutAGap) {
  const auto whole = swelling_tone(24'000, 6.0);
  auto coder = new_coder();
  std::vector<CodedSound> packets;
  std::size_t from = 0;
  for (const std::size_t samples : {31'337U, 1'000U, 47'003U, 17'001U, 47'659U}) {
    const auto until = std::min(from + samples, whole.size());
    ASSERT_TRUE(coder.add(std::span(whole).subspan(from, until - from), 24'000));
    const double end = coder.end();
    EXPECT_GE(end, static_cast<double>(until) / 24.0 - 1e-9);
    EXPECT_LT(end, static_cast<double>(until) / 24.0 + 10.0);
    // What a part was completed by is missing in the tone: the times stay those of the whole.
    from = std::min(whole.size(), static_cast<std::size_t>(std::lround(end * 24.0)));
    while (!coder.done()) {
      const auto some = coder.code(500.0);
      ASSERT_TRUE(some);
      packets.insert(packets.end(), some->begin(), some->end());
    }
  }
  const auto parts = decoded(packets), once = decoded(coded(whole, 24'000));
  const auto sent = std::accumulate(packets.begin(), packets.end(), 0.0, [](double ms, const CodedSound& one) {
    return ms + opus_packet_get_samples_per_frame(one.packet.data(), 48'000) / 48.0 *
                    opus_packet_get_nb_frames(one.packet.data(), static_cast<opus_int32>(one.packet.size()));
  });
  EXPECT_NEAR(sent, 6000.0, 10.0) << "every ms is in a packet";
  const auto a = envelope(parts, 48'000.0), b = envelope(once, 48'000.0);
  EXPECT_EQ(lag(a, b), 0);
  double difference = 0.0, all = 0.0;
  for (std::size_t ms = 0; ms < std::min(a.size(), b.size()); ++ms) {
    difference += std::abs(a[ms] - b[ms]);
    all += b[ms];
  }
  EXPECT_LT(difference / all, 0.1);
}

TEST(SoundCoder, Pause_IsNotCoded_AndTimeGoesOn) {
  const auto tone = swelling_tone(24'000, 1.0);
  auto coder = new_coder();
  ASSERT_TRUE(coder.add(tone, 24'000));
  all_of(coder);
  const double end = coder.end();
  ASSERT_TRUE(coder.add(tone, 24'000));
  coder.pause(730.0);
  EXPECT_NEAR(coder.end(), end + 730.0 + 1000.0, 10.0);
  const auto packets = all_of(coder);
  EXPECT_NEAR(static_cast<double>(packets[0].time), end + 730.0, 10.0);
}

TEST(SoundCoder, Speech_TakesItsBitrate) {
  double bits = 0.0;
  for (const auto& one : coded(swelling_tone(24'000, 6.0), 24'000))
    bits += 8.0 * static_cast<double>(one.packet.size());
  EXPECT_LE(bits / 6.0, 24'000.0);
}

TEST(SoundCoder, Silence_IsNotSent) {
  const std::vector<std::int16_t> silence(24'000 * 6, 0);
  EXPECT_LT(coded(silence, 24'000).size(), 25U) << "of 100";
}

TEST(SoundCoder, LessThanAPacket_IsShortOnes) {
  const auto packets = coded(swelling_tone(24'000, 0.02), 24'000);
  ASSERT_FALSE(packets.empty());
  EXPECT_LE(decoded(packets).size(), 48U * 20U);
  EXPECT_TRUE(coded({}, 24'000).empty());
}

TEST(SoundCoder, RateOutOfRange_IsRefused) {
  for (const std::uint32_t rate : {0U, 7'999U, 48'001U}) {
    const auto added = new_coder().add(swelling_tone(8'000, 0.1), rate);
    ASSERT_FALSE(added);
    EXPECT_EQ(added.error().code, ErrorCode::out_of_range);
  }
}

}  // namespace
}  // namespace semblante::voice
