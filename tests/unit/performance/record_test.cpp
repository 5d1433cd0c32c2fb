#include "core/performance/record.h"

#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <random>

#include <gtest/gtest.h>

#include "core/performance/performance.h"
#include "core/tables/mpeg4.h"
#include "protocol/cpp/kernel_values.h"
#include "protocol/cpp/performance_document.h"

namespace semblante {
namespace {

/// What FAPs 1 and 2 mean: the weight of each viseme and of each expression, in sixty-thirds.
std::array<int, 22> meaning(const semblante_frame& frame) {
  std::array<int, 22> weights{};
  weights[frame.viseme1] += frame.viseme_blend;
  weights[frame.viseme2] += 63 - frame.viseme_blend;
  weights[15U + frame.expression1] += frame.intensity1;
  weights[15U + frame.expression2] += frame.intensity2;
  weights[0] = weights[15] = 0;  // silence, none
  return weights;
}

void expect_same(const std::vector<RecordedFrame>& frames, const Performance& performance, double steps) {
  for (const RecordedFrame& frame : frames) {
    const auto face = performance.frame_at(frame.time - frames.front().time);
    const auto expected = meaning(frame.face);
    const auto actual = meaning(face);
    for (std::size_t i = 0; i < expected.size(); ++i)
      ASSERT_LE(std::abs(actual[i] - expected[i]), steps == 0.0 ? 0.0 : steps + 0.5) << i << " at " << frame.time;
    for (std::size_t n = 3; n <= 68; ++n) {
      const double step = mpeg4::fap(n).quantizer_step;
      ASSERT_NEAR(face.fap[n], frame.face.fap[n], steps * step + 1e-3) << "FAP " << n << " at " << frame.time;
      if (frame.face.fap[n] == 0.0F) {
        ASSERT_EQ(face.fap[n], 0.0F) << "absent stays absent, FAP " << n;
      }
    }
  }
}

Performance played_back(const std::vector<RecordedFrame>& frames, double tolerance, std::size_t* keys = nullptr) {
  const auto script = record_performance(frames, {tolerance});
  EXPECT_TRUE(script);
  if (keys != nullptr) {
    *keys = 0;
    for (const Cue& cue : script->cues) *keys += cue.keys.size();
  }
  // By way of the document: what is written down must be enough.
  const auto read = read_performance(write_performance(*script));
  EXPECT_TRUE(read) << (read ? "" : read.error().where + " " + read.error().message);
  auto made = Performance::compile(*read);
  EXPECT_TRUE(made) << (made ? "" : made.error().where + " " + made.error().message);
  return std::move(*made);
}

std::vector<RecordedFrame> recorded_minute() {
  std::ifstream file(std::string(SEMBLANTE_SOURCE_DIR) + "/protocol/examples/performances/minute.json");
  const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  const auto script = read_performance(text);
  EXPECT_TRUE(script);
  const auto minute = Performance::compile(*script);
  std::vector<RecordedFrame> frames;
  for (double t = 0.0; t < 60'000.0; t += 40.0) {
    RecordedFrame frame{t + 500.0, minute->frame_at(t)};
    const FaceFrame levels = quantized(frame.face);  // as a stream has them
    for (std::size_t n = 3; n <= 68; ++n)
      frame.face.fap[n] = static_cast<float>(levels.level[n] * mpeg4::fap(n).quantizer_step);
    frames.push_back(frame);
  }
  return frames;
}

TEST(Record, AMinuteOfAStream_ComesBackWithinTheTolerance) {
  const auto frames = recorded_minute();
  std::size_t exact = 0;
  std::size_t half = 0;
  std::size_t coarse = 0;
  expect_same(frames, played_back(frames, 0.0, &exact), 0.0);
  expect_same(frames, played_back(frames, 0.5, &half), 0.5);
  expect_same(frames, played_back(frames, 3.0, &coarse), 3.0);
  EXPECT_LT(half, exact);
  EXPECT_LT(coarse, half * 3 / 4);
}

TEST(Record, RandomFrames_ComeBack) {
  std::mt19937 random(11);
  std::vector<RecordedFrame> frames;
  double time = 0.0;
  for (int i = 0; i < 500; ++i) {
    RecordedFrame frame;
    frame.time = time;
    time += 1.0 + static_cast<double>(random() % 80);
    frame.face.viseme1 = static_cast<std::uint8_t>(random() % 3);
    frame.face.viseme2 = static_cast<std::uint8_t>(random() % 3);
    frame.face.viseme_blend = static_cast<std::uint8_t>(random() % 64);
    frame.face.expression1 = static_cast<std::uint8_t>(random() % 7);
    frame.face.intensity1 = static_cast<std::uint8_t>(random() % 32);
    frame.face.expression2 = static_cast<std::uint8_t>(random() % 7);
    frame.face.intensity2 = static_cast<std::uint8_t>(random() % 32);
    for (std::size_t n = 3; n <= 68; ++n) {
      const int level = static_cast<int>(random() % 400) - 200;
      frame.face.fap[n] = random() % 3 == 0 ? 0.0F : static_cast<float>(level * mpeg4::fap(n).quantizer_step);
    }
    frames.push_back(frame);
  }
  expect_same(frames, played_back(frames, 0.0), 0.0);
  expect_same(frames, played_back(frames, 0.5), 0.5);
}

TEST(Record, StraightLine_TakesTwoKeys) {
  std::vector<RecordedFrame> frames;
  for (int i = 0; i <= 100; ++i) {
    RecordedFrame frame;
    frame.time = 40.0 * i;
    frame.face.fap[3] = 10.0F + 4.0F * static_cast<float>(i);
    frames.push_back(frame);
  }
  const auto script = record_performance(frames);
  ASSERT_TRUE(script);
  ASSERT_EQ(script->cues.size(), 1U);
  EXPECT_EQ(script->cues[0].keys.size(), 2U);
  EXPECT_EQ(script->duration, 4040.0);
}

TEST(Record, BadRecordings_AreRefused) {
  EXPECT_EQ(record_performance({}).error().code, ErrorCode::empty);
  std::vector<RecordedFrame> frames(2);
  frames[0].time = 5.0;
  EXPECT_EQ(record_performance(frames).error().where, "/frames/1");
  frames[1].time = 6.0;
  frames[1].face.fap[5] = std::nanf("");
  EXPECT_EQ(record_performance(frames).error().where, "/frames/1");
  frames[1].face.fap[5] = 0.0F;
  EXPECT_EQ(record_performance(frames, {-1.0}).error().where, "tolerance");
}

}  // namespace
}  // namespace semblante
