#include "protocol/cpp/quantizers.h"

#include <gtest/gtest.h>

#include "protocol/cpp/fap_ranges.h"
#include "protocol/cpp/frame_codec.h"
#include "tests/support/frame_encoder.h"

namespace semblante {
namespace {

TEST(Quantizers, Scales_AreThoseOfPowersOfTwo) {
  for (const double scale : quantizer_scales) EXPECT_TRUE(is_quantizer_scale(scale));
  for (const double scale : {0.0, -1.0, 2.0, 0.3, 0.0625}) EXPECT_FALSE(is_quantizer_scale(scale)) << scale;
  EXPECT_EQ(scaled_quantizers(1.0), standard_quantizers());
  EXPECT_EQ(scaled_quantizers(0.25)[23], 32.0);
}

TEST(Quantizers, HeaderQuantizers_ReadBackAsTheSteps) {
  for (const double scale : quantizer_scales) {
    Header header;
    header.quantizers = header_quantizers(scale);
    const auto read = FrameDecoder().decode(FrameEncoder().encode(header));
    ASSERT_TRUE(read.ok());
    EXPECT_EQ(quantizers_of(std::get<Header>(*read)), scaled_quantizers(scale));
  }
  EXPECT_TRUE(header_quantizers(1.0).empty());
}

TEST(Quantizers, Requantized_ToFinerAndBack_IsTheSame) {
  FaceFrame frame;
  frame.viseme = {3, 4, 5};
  for (std::size_t fap = 3; fap <= 68; ++fap) frame.level[fap] = static_cast<std::int16_t>(fap * 37 % 400 - 200);
  for (const double scale : quantizer_scales) {
    const FaceFrame finer = requantized(frame, standard_quantizers(), scaled_quantizers(scale));
    EXPECT_EQ(finer.level[50], frame.level[50] / scale);
    EXPECT_EQ(finer.viseme, frame.viseme);
    EXPECT_EQ(requantized(finer, scaled_quantizers(scale), standard_quantizers()), frame);
  }
}

TEST(Quantizers, Requantized_RoundsToTheNearestAndStopsAtTheLimit) {
  FaceFrame frame;
  frame.level[3] = 3;
  frame.level[4] = -3;
  frame.level[5] = 5;
  EXPECT_EQ(requantized(frame, scaled_quantizers(0.5), standard_quantizers()).level[3], 2);
  EXPECT_EQ(requantized(frame, scaled_quantizers(0.5), standard_quantizers()).level[4], -2);
  EXPECT_EQ(requantized(frame, scaled_quantizers(0.25), standard_quantizers()).level[5], 1);
  frame.level[3] = -32767;
  EXPECT_EQ(requantized(frame, standard_quantizers(), scaled_quantizers(0.125)).level[3], -32767);
}

TEST(Quantizers, Ranges_OfFinerSteps_AreTheSameFaces) {
  for (std::size_t fap = 3; fap <= 68; ++fap) {
    EXPECT_EQ(level_range(fap, 0.25).most, std::min(4 * level_range(fap).most, 32767));
    EXPECT_EQ(level_range(fap, 0.25).least, std::max(4 * level_range(fap).least, -32767));
  }
  FaceFrame frame;
  frame.level[48] = static_cast<std::int16_t>(level_range(48).most + 1);
  EXPECT_EQ(clamp_to_ranges(frame, 0.5), 0U);
  EXPECT_EQ(clamp_to_ranges(frame), 1U);
  EXPECT_EQ(frame.level[48], level_range(48).most);
}

}  // namespace
}  // namespace semblante
