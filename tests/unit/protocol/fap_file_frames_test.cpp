#include "protocol/cpp/fap_file_frames.h"

#include <gtest/gtest.h>

#include "protocol/cpp/json_codec.h"

namespace semblante {
namespace {

FapFileFrame frame(std::uint32_t number, std::initializer_list<std::pair<std::size_t, double>> values) {
  FapFileFrame frame;
  frame.number = number;
  for (const auto& [fap, value] : values) {
    frame.present.set(fap);
    frame.value[fap] = value;
  }
  return frame;
}

TimedValues at(std::uint32_t time, std::initializer_list<std::pair<std::size_t, double>> values) {
  TimedValues timed{time, {}};
  for (const auto& [fap, value] : values) timed.state.fap[fap] = value;
  return timed;
}

TEST(FapFrames, AbsentFap_ByDefault_IsZero) {
  const FapFile file{25, "", {frame(0, {{3, 100}, {19, 1024}}), frame(1, {{3, 200}})}};
  const auto frames = frames_of(file);
  ASSERT_TRUE(frames);
  EXPECT_EQ(*frames, (std::vector<TimedValues>{at(0, {{3, 100}, {19, 1024}}), at(40, {{3, 200}})}));
}

TEST(FapFrames, AbsentFap_Kept_StaysAsItWas) {
  FapFile file{25, "", {frame(0, {{19, 1024}}), frame(1, {{3, 200}}), frame(2, {{19, 0}})}};
  file.frames[0].present.set(1);
  file.frames[0].viseme = {10, 0, 63, 1};
  file.frames[0].present.set(2);
  file.frames[0].expression = {1, 40, 2, 20, 1, 1};
  const auto frames = frames_of(file, {AbsentFap::keep, FrameGap::hold});
  ASSERT_TRUE(frames);
  ASSERT_EQ(frames->size(), 3U);
  EXPECT_EQ((*frames)[2].state.fap[3], 200);
  EXPECT_EQ((*frames)[1].state.fap[19], 1024);
  EXPECT_EQ((*frames)[2].state.fap[19], 0);
  EXPECT_EQ((*frames)[2].state.viseme, (VisemeBlend{10, 0, 63}));
  EXPECT_EQ((*frames)[2].state.expression, (ExpressionBlend{1, 40, 2, 20}));
}

TEST(FapFrames, ActiveViseme_LeavesLowLevelFapsOn) {
  FapFile file{25, "", {frame(0, {{3, 100}})}};
  file.frames[0].present.set(1);
  file.frames[0].viseme = {1, 0, 63, 0};
  EXPECT_EQ(frames_of(file)->front().state.fap[3], 100);
}

TEST(FapFrames, Gap_Held_EndsInACopyOneFrameBeforeTheNext) {
  const FapFile file{10, "", {frame(0, {{3, 10}}), frame(5, {{3, 60}}), frame(6, {{3, 70}})}};
  EXPECT_EQ(*frames_of(file),
            (std::vector<TimedValues>{at(0, {{3, 10}}), at(400, {{3, 10}}), at(500, {{3, 60}}), at(600, {{3, 70}})}));
  EXPECT_EQ(*frames_of(file, {AbsentFap::zero, FrameGap::interpolate}),
            (std::vector<TimedValues>{at(0, {{3, 10}}), at(500, {{3, 60}}), at(600, {{3, 70}})}));
}

TEST(FapFrames, LongerThanADay_IsRefused) {
  const FapFile file{0.01, "", {frame(0, {}), frame(864, {})}};
  EXPECT_TRUE(frames_of(file));
  const FapFile longer{0.01, "", {frame(0, {}), frame(865, {})}};
  EXPECT_EQ(frames_of(longer).error().code, ErrorCode::out_of_range);
}

TEST(FapFrames, RateOfTimes_IsTheLowestThatHasThemAll) {
  EXPECT_EQ(rate_of(std::vector{at(0, {}), at(40, {}), at(120, {})}), 25);
  EXPECT_EQ(rate_of(std::vector{at(0, {}), at(33, {}), at(67, {}), at(100, {})}), 30);
  EXPECT_EQ(rate_of(std::vector{at(7, {})}), 25);
  EXPECT_EQ(rate_of(std::vector{at(0, {}), at(1, {})}), 667);  // 1.4993 ms
}

TEST(FapFrames, FileOfFrames_HasOneMaskAndNoGaps) {
  const std::vector<TimedValues> frames = {at(1000, {{3, 10.4}}), at(1120, {{19, 512}, {3, 40}})};
  const auto file = fap_file_of(frames, {25, true, "n"});
  ASSERT_TRUE(file);
  EXPECT_EQ(*file, (FapFile{25,
                            "n",
                            {frame(0, {{3, 10}, {19, 0}}), frame(1, {{3, 20}, {19, 171}}),
                             frame(2, {{3, 30}, {19, 341}}), frame(3, {{3, 40}, {19, 512}})}}));
  // Reals, if they are wanted: 10.4 + 29.6 / 3.
  EXPECT_NEAR(fap_file_of(frames, {25, false, "n"})->frames[1].value[3], 10.4 + 29.6 / 3, 1e-12);
}

TEST(FapFrames, FileOfFrames_BetweenSelectsThatChange_HoldsFap1) {
  std::vector<TimedValues> frames = {at(0, {}), at(80, {}), at(160, {})};
  frames[0].state.viseme = {1, 0, 63};
  frames[1].state.viseme = {1, 0, 31};
  frames[2].state.viseme = {10, 0, 63};
  const auto file = fap_file_of(frames, {25, true, ""});
  ASSERT_TRUE(file);
  ASSERT_EQ(file->frames.size(), 5U);
  EXPECT_EQ(file->frames[1].viseme, (FapFileViseme{1, 0, 47, 0}));
  EXPECT_EQ(file->frames[3].viseme, (FapFileViseme{1, 0, 31, 0}));
  EXPECT_EQ(file->frames[4].viseme, (FapFileViseme{10, 0, 63, 0}));
}

TEST(FapFrames, FileOfFrames_OfSeveralInOneFrame_TheLastCounts) {
  const auto file = fap_file_of(std::vector{at(0, {{3, 1}}), at(190, {{3, 2}}), at(200, {{3, 5}})}, {10, true, ""});
  ASSERT_TRUE(file);
  EXPECT_EQ(file->frames.size(), 3U);
  EXPECT_EQ(file->frames[1].value[3], 3);
  EXPECT_EQ(file->frames[2].value[3], 5);
}

TEST(FapFrames, FileOfFrames_TooMany_IsRefused) {
  EXPECT_EQ(fap_file_of({}).error().code, ErrorCode::empty);
  EXPECT_EQ(fap_file_of(std::vector{at(0, {}), at(86'400'000, {})}, {25, true, ""}).error().code, ErrorCode::too_large);
}

TEST(FapFrames, ThereAndBack_AtAnyRate_IsTheSameFile) {
  for (const double rate : {2.0, 12.5, 24.0, 25.0, 29.97, 30.0, 60.0, 100.0}) {
    FapFile file{rate, "x", {}};
    for (std::uint32_t i = 0; i < 200; ++i) file.frames.push_back(frame(i, {{3, i}, {49, -170.0 * i}}));
    const auto frames = frames_of(file);
    ASSERT_TRUE(frames);
    EXPECT_EQ(*fap_file_of(*frames, {rate, true, "x"}), file) << rate;
  }
}

TEST(FaceValues, JsonFile_WrittenAndRead_IsExact) {
  std::vector<TimedValues> frames = {at(0, {}), at(40, {{3, 0.1}, {19, -1024}}), at(80, {{68, 1e9}})};
  frames[1].state.viseme = {10, 3, 5};
  frames[2].state.expression = {1, 63, 2, 0};
  const auto back = decode_json_values(encode_json_values(frames));
  ASSERT_TRUE(back) << back.error().where << back.error().message;
  EXPECT_EQ(*back, frames);
}

TEST(FaceValues, JsonFile_MayBeLongerThanAMessage_UpToItsLimit) {
  std::vector<TimedValues> frames(5000);
  EXPECT_EQ(decode_json_values(encode_json_values(frames))->size(), 5000U);
  EXPECT_EQ(decode_json_values(encode_json_values(frames), {1 << 20, 4999}).error().where, "/frames");
  const auto far = decode_json_values(R"({"frames":[{"faps":{"3":2e9}}]})");
  ASSERT_FALSE(far);
  EXPECT_EQ(far.error().where, "/frames/0/faps/3");
}

TEST(FaceValues, ToFrame_RoundsAndSaturates) {
  FaceValues values;
  values.fap[3] = 10;    // step 4
  values.fap[14] = 1e8;  // step 1
  values.fap[15] = -1e8;
  const FaceFrame frame = to_frame(values);
  EXPECT_EQ(frame.level[3], 3);
  EXPECT_EQ(frame.level[14], 32767);
  EXPECT_EQ(frame.level[15], -32767);
  EXPECT_EQ(to_values(frame).fap[3], 12);
}

}  // namespace
}  // namespace semblante
