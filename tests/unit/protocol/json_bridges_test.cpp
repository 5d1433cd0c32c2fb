#include <string>

#include <gtest/gtest.h>

#include "core/bridges/arkit.h"
#include "protocol/cpp/json_codec.h"

namespace semblante {
namespace {

Result<std::vector<TimedFrame>> read_one(const std::string& frame) {
  return decode_json_frames(R"({"frames":[)" + frame + "]}");
}

FaceFrame state_of(const std::string& frame) {
  const auto frames = read_one(frame);
  EXPECT_TRUE(frames.ok()) << frames.error().where << " " << frames.error().message;
  return frames.ok() ? frames->front().state : FaceFrame{};
}

std::string fifty_two(const char* name, const char* value) {
  std::string text = "[";
  for (std::size_t s = 0; s < arkit_count; ++s)
    text.append(s > 0 ? "," : "").append(arkit_name(s) == name ? value : "0");
  return text + "]";
}

TEST(JsonArkit, NamesAndArray_AreOneFace) {
  const FaceFrame named = state_of(R"({"arkit":{"jawOpen":0.5}})");
  EXPECT_GT(named.level[3], 50);
  EXPECT_LT(named.level[5], -100);
  EXPECT_EQ(named.viseme.select1, 10);
  EXPECT_EQ(state_of(R"({"arkit":)" + fifty_two("jawOpen", "0.5") + "}"), named);
  EXPECT_EQ(state_of(R"({"arkit":{"JawOpen":0.5}})"), named);
}

TEST(JsonArkit, SixtyOne_TurnTheHead) {
  std::string array = fifty_two("", "0");
  array.pop_back();
  array += ",0.5,0.25,-0.125,0,0,0,0,0,0]";
  const FaceFrame state = state_of(R"({"arkit":)" + array + "}");
  EXPECT_NEAR(state.level[49] * 170.0, -50000.0, 170.0);
  EXPECT_NEAR(state.level[48] * 170.0, 25000.0, 170.0);
  EXPECT_NEAR(state.level[50] * 170.0, -12500.0, 170.0);
  EXPECT_EQ(state_of(R"({"arkit":{"headYaw":0.5,"headPitch":0.25,"HeadRoll":-0.125,"leftEyeYaw":1}})"), state);
}

TEST(JsonArkit, ExplicitMembers_WinOnTheirOwn) {
  const FaceFrame arkit = state_of(R"({"arkit":{"jawOpen":0.5,"browInnerUp":1}})");
  FaceFrame expected = arkit;
  expected.level[5] = 100;
  expected.level[31] = 0;
  expected.viseme = {1, 0, 20};
  EXPECT_EQ(state_of(R"({"arkit":{"jawOpen":0.5,"browInnerUp":1},"faps":{"5":200,"31":0},)"
                     R"("viseme":{"select1":1,"blend":20}})"),
            expected);
}

TEST(JsonArkit, OutOfRange_IsTakenAsTheEndOfIt) {
  EXPECT_EQ(state_of(R"({"arkit":{"jawOpen":7,"mouthFunnel":-3}})"), state_of(R"({"arkit":{"jawOpen":1}})"));
  EXPECT_EQ(state_of(R"({"arkit":{"jawOpen":1e300}})"), state_of(R"({"arkit":{"jawOpen":1}})"));
}

TEST(JsonBridges, WhatIsClamped_IsCounted) {
  std::size_t clamped = 7;
  ASSERT_TRUE(decode_json_frames(R"({"frames":[{"arkit":{"jawOpen":7,"mouthFunnel":-3,"browInnerUp":1}},)"
                                 R"({"oculus":{"aa":1.5}},{"faps":{"3":9}}]})",
                                 standard_quantizers(), &clamped));
  EXPECT_EQ(clamped, 3U);
}

TEST(JsonOculus, NamesAndArray_AreFap1) {
  FaceFrame expected;
  expected.viseme = {10, 1, 47};
  EXPECT_EQ(state_of(R"({"oculus":{"aa":0.75,"PP":0.25}})"), expected);
  EXPECT_EQ(state_of(R"({"oculus":[0,0.25,0,0,0,0,0,0,0,0,0.75,0,0,0,0]})"), expected);
  // Beside arkit it goes before what carries the jaw.
  EXPECT_EQ(state_of(R"({"arkit":{"jawOpen":1},"oculus":{"PP":1}})").viseme.select1, 1);
}

TEST(JsonBridges, Wrong_IsRefusedAtItsPlace) {
  struct Case {
    const char* frame;
    const char* where;
    ErrorCode code;
  };
  const std::vector<Case> cases = {
      {R"({"arkit":{"jawopen":1}})", "/frames/0/arkit/jawopen", ErrorCode::invalid_argument},
      {R"({"arkit":{"jawOpen":"1"}})", "/frames/0/arkit/jawOpen", ErrorCode::malformed},
      {R"({"arkit":[1,2]})", "/frames/0/arkit", ErrorCode::out_of_range},
      {R"({"arkit":3})", "/frames/0/arkit", ErrorCode::malformed},
      {R"({"oculus":{"aaa":1}})", "/frames/0/oculus/aaa", ErrorCode::invalid_argument},
      {R"({"oculus":[1]})", "/frames/0/oculus", ErrorCode::out_of_range},
      {R"({"oculus":{"aa":1},"viseme":{"select1":2}})", "/frames/0/oculus", ErrorCode::invalid_argument},
  };
  for (const Case& c : cases) {
    const auto frames = read_one(c.frame);
    ASSERT_FALSE(frames.ok()) << c.frame;
    EXPECT_EQ(frames.error().where, c.where) << c.frame;
    EXPECT_EQ(frames.error().code, c.code) << c.frame;
  }
  const auto between = read_one(R"({"arkit":)" + fifty_two("", "0").substr(0, 2 * arkit_count) + ",0]}");
  ASSERT_FALSE(between.ok());
  EXPECT_EQ(between.error().where, "/frames/0/arkit");
}

}  // namespace
}  // namespace semblante
