// Sound files of others.
#include "core/speech/wav.h"

#include <bit>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace semblante {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string number(std::uint32_t value, int count) {
  std::string bytes;
  for (int i = 0; i < count; ++i) bytes += static_cast<char>(value >> (8 * i) & 0xFFU);
  return bytes;
}
std::string chunk(const std::string& name, const std::string& content) {
  return name + number(static_cast<std::uint32_t>(content.size()), 4) + content + (content.size() % 2 ? "\0" : "");
}
std::string file(std::uint32_t tag, std::uint32_t channels, std::uint32_t bits, const std::string& data,
                 std::uint32_t rate = 8000, const std::string& before = "") {
  const std::string format = number(tag, 2) + number(channels, 2) + number(rate, 4) +
                             number(rate * channels * bits / 8, 4) + number(channels * bits / 8, 2) + number(bits, 2);
  return "RIFF" + number(0, 4) + "WAVE" + before + chunk("fmt ", format) + chunk("data", data);
}
std::string real(float value) { return number(std::bit_cast<std::uint32_t>(value), 4); }

std::vector<std::int16_t> samples(const std::string& bytes) {
  const auto read = read_wav(bytes);
  EXPECT_TRUE(read.ok()) << read.error().message;
  return read.ok() ? read->samples : std::vector<std::int16_t>{};
}

TEST(Wav, EveryWidthIsTheSameSound) {
  EXPECT_THAT(samples(file(1, 1, 8, std::string("\x80\xC0\x00", 3))), ElementsAre(0, 16384, -32768));
  EXPECT_THAT(samples(file(1, 1, 16, number(0x4000, 2) + number(0x8000, 2))), ElementsAre(16384, -32768));
  EXPECT_THAT(samples(file(1, 1, 24, number(0x400000, 3) + number(0x800000, 3))), ElementsAre(16384, -32768));
  EXPECT_THAT(samples(file(1, 1, 32, number(0x40000000, 4))), ElementsAre(16384));
  EXPECT_THAT(samples(file(3, 1, 32, real(0.5F) + real(-7.0F) + real(std::nanf("")))), ElementsAre(16384, -32768, 0));
}

TEST(Wav, ChannelsAreMixed_OtherChunksSkipped_AnEndThatIsMissingIsTheFiles) {
  EXPECT_THAT(samples(file(1, 2, 16, number(100, 2) + number(300, 2))), ElementsAre(200));
  EXPECT_THAT(samples(file(1, 1, 16, number(7, 2), 8000, "LIST" + number(4, 4) + "abcd")), ElementsAre(7));
  std::string piped = file(1, 1, 16, number(7, 2));
  piped.replace(piped.size() - 6, 4, number(0xFFFFFFFF, 4));
  EXPECT_THAT(samples(piped), ElementsAre(7));
}

TEST(Wav, OursComesBack) {
  Utterance said;
  said.sample_rate = 22050;
  said.samples = {1, -2, 32767, -32768};
  const auto read = read_wav(wav(said));
  ASSERT_TRUE(read.ok());
  EXPECT_EQ(read->sample_rate, 22050U);
  EXPECT_EQ(read->samples, said.samples);
}

TEST(Wav, WhatIsWrong_IsNamedWithItsByte) {
  const auto refused = [](const std::string& bytes, const char* where, const char* message) {
    const auto read = read_wav(bytes);
    ASSERT_FALSE(read.ok());
    EXPECT_EQ(read.error().where, where);
    EXPECT_THAT(read.error().message, HasSubstr(message));
  };
  refused("", "byte 0", "no WAV");
  refused("RIFF....WAVX", "byte 0", "no WAV");
  refused("RIFF....WAVE", "byte 12", "no chunk");
  refused("RIFF....WAVE" + chunk("data", "ab"), "byte 12", "must come before");
  refused("RIFF....WAVE" + chunk("fmt ", "ab"), "byte 12", "fewer than 16");
  refused(file(7, 1, 8, "a"), "byte 12", "neither PCM");
  refused(file(1, 0, 16, "ab"), "byte 12", "channels");
  refused(file(1, 1, 16, "ab", 400), "byte 12", "samples a second");
  refused(file(1, 1, 16, ""), "byte 36", "no sound");
  refused(file(1, 1, 8, std::string(8000 * 1200 + 1, 'a')), "byte 36", "longer than 1200 s");
}

}  // namespace
}  // namespace semblante
