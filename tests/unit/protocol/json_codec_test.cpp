#include "protocol/cpp/json_codec.h"

#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "tests/unit/protocol/messages_for_tests.h"

namespace semblante {
namespace {

void expect_refused(std::string_view text, ErrorCode code, std::string_view where) {
  const auto result = decode_json(text);
  ASSERT_FALSE(result.ok()) << text;
  EXPECT_EQ(result.error().code, code) << text << ": " << result.error().message;
  EXPECT_EQ(result.error().where, where) << text << ": " << result.error().message;
}

TEST(JsonDecode, Decode_NotAMessage_IsRefused) {
  expect_refused("", ErrorCode::malformed, "");
  expect_refused("{", ErrorCode::malformed, "");
  expect_refused("[]", ErrorCode::malformed, "");
  expect_refused("\"hello\"", ErrorCode::malformed, "");
  expect_refused("{} {}", ErrorCode::malformed, "");
  expect_refused("{\"type\":\"hello\",\"version\":NaN}", ErrorCode::malformed, "");
  expect_refused("\xff", ErrorCode::malformed, "");
  expect_refused("{}", ErrorCode::missing, "/type");
  expect_refused(R"({"type":1})", ErrorCode::malformed, "/type");
  expect_refused(R"({"type":"shout"})", ErrorCode::unsupported, "/type");
  expect_refused(std::string(max_json_message_bytes + 1, ' '), ErrorCode::too_large, "");
  std::string zeros;
  for (int i = 0; i < 64; ++i) zeros += "/0";
  expect_refused(std::string(100000, '['), ErrorCode::too_large, zeros);
  expect_refused(R"({"type":"hello","version":1,"version":2})", ErrorCode::malformed, "/version");
}

TEST(JsonDecode, Decode_InvalidMembers_AreNamedByTheirPointer) {
  expect_refused(R"({"type":"hello"})", ErrorCode::missing, "/version");
  expect_refused(R"({"type":"hello","version":"1"})", ErrorCode::malformed, "/version");
  expect_refused(R"({"type":"hello","version":1.5})", ErrorCode::malformed, "/version");
  expect_refused(R"({"type":"hello","version":-1})", ErrorCode::out_of_range, "/version");
  expect_refused(R"({"type":"hello","version":65536})", ErrorCode::out_of_range, "/version");
  expect_refused(R"({"type":"hello","version":1e999})", ErrorCode::not_finite, "/version");
  expect_refused(R"({"type":"hello","version":1,"role":"listen"})", ErrorCode::invalid_argument, "/role");
  expect_refused(R"({"type":"hello","version":1,"role":0})", ErrorCode::malformed, "/role");
  expect_refused(R"({"type":"hello","version":1,"resume":3})", ErrorCode::malformed, "/resume");
  expect_refused(R"({"type":"hello","version":1,"resume":{"epoch":1}})", ErrorCode::missing, "/resume/sequence");
  expect_refused(R"({"type":"ping","client_time":"now"})", ErrorCode::malformed, "/client_time");
  expect_refused(R"({"type":"frames"})", ErrorCode::missing, "/frames");
  expect_refused(R"({"type":"frames","frames":{}})", ErrorCode::malformed, "/frames");
  expect_refused(R"({"type":"frames","frames":[]})", ErrorCode::out_of_range, "/frames");
  expect_refused(R"({"type":"frames","frames":[1]})", ErrorCode::malformed, "/frames/0");
  expect_refused(R"({"type":"frames","frames":[{"faps":{"99":1}}]})", ErrorCode::out_of_range, "/frames/0/faps/99");
  expect_refused(R"({"type":"frames","frames":[{"faps":{"2":1}}]})", ErrorCode::out_of_range, "/frames/0/faps/2");
  expect_refused(R"({"type":"frames","frames":[{"faps":{"03":1}}]})", ErrorCode::out_of_range, "/frames/0/faps/03");
  expect_refused(R"({"type":"frames","frames":[{"faps":{"a/b":1}}]})", ErrorCode::out_of_range, "/frames/0/faps/a~1b");
  expect_refused(R"({"type":"frames","frames":[{"faps":[1]}]})", ErrorCode::malformed, "/frames/0/faps");
  expect_refused(R"({"type":"frames","frames":[{},{"faps":{"3":"wide"}}]})", ErrorCode::malformed, "/frames/1/faps/3");
  expect_refused(R"({"type":"frames","frames":[{"faps":{"3":null}}]})", ErrorCode::malformed, "/frames/0/faps/3");
  // The step of FAP 3 is 4: 32767 levels are 131068, the next level begins at 131070.
  expect_refused(R"({"type":"frames","frames":[{"faps":{"3":131070}}]})", ErrorCode::out_of_range, "/frames/0/faps/3");
  expect_refused(R"({"type":"frames","frames":[{"faps":{"3":-1e300}}]})", ErrorCode::out_of_range, "/frames/0/faps/3");
  expect_refused(R"({"type":"frames","frames":[{"viseme":{"select1":15}}]})", ErrorCode::out_of_range,
                 "/frames/0/viseme/select1");
  expect_refused(R"({"type":"frames","frames":[{"viseme":{"select1":"a"}}]})", ErrorCode::malformed,
                 "/frames/0/viseme/select1");
  expect_refused(R"({"type":"frames","frames":[{"viseme":{}}]})", ErrorCode::missing, "/frames/0/viseme/select1");
  expect_refused(R"({"type":"frames","frames":[{"viseme":3}]})", ErrorCode::malformed, "/frames/0/viseme");
  expect_refused(R"({"type":"frames","frames":[{"viseme":{"select1":1,"blend":64}}]})", ErrorCode::out_of_range,
                 "/frames/0/viseme/blend");
  expect_refused(R"({"type":"frames","frames":[{"expression":{"select1":7}}]})", ErrorCode::out_of_range,
                 "/frames/0/expression/select1");
  expect_refused(R"({"type":"frames","frames":[{"expression":{"select1":1,"intensity1":63.5}}]})", ErrorCode::malformed,
                 "/frames/0/expression/intensity1");
  expect_refused(R"({"type":"frames","frames":[{"time":40},{"time":39}]})", ErrorCode::out_of_range, "/frames/1/time");
  expect_refused(R"({"type":"keyframe"})", ErrorCode::missing, "/state");
  expect_refused(R"({"type":"header","version":1,"stream":"s","epoch":1,"sequence":0,"media_time":0,"quantizers":[1]})",
                 ErrorCode::out_of_range, "/quantizers");
}

TEST(JsonDecode, Decode_TooManyFrames_IsRefused) {
  std::string text = R"({"type":"frames","frames":[{})";
  for (std::size_t i = 0; i < max_frames_per_message; ++i) text += ",{}";
  expect_refused(text + "]}", ErrorCode::too_large, "/frames");
}

TEST(JsonDecode, Decode_EveryPrefix_IsRefused) {
  for (const Message& message : one_of_each()) {
    const std::string good = encode_json(message);
    for (std::size_t size = 0; size < good.size(); size += 1 + size / 200) {
      ASSERT_FALSE(decode_json(std::string_view(good).substr(0, size)).ok()) << good.substr(0, size);
    }
  }
}

TEST(JsonDecode, Decode_ChangedBytes_NeverCrashes) {
  std::mt19937 random(4);
  const auto messages = one_of_each();
  for (int round = 0; round < 5000; ++round) {
    std::string text = encode_json(messages[random() % messages.size()]);
    for (int k = 0; k < 3; ++k) text[random() % text.size()] = static_cast<char>(random());
    const auto result = decode_json(text);
    if (result) static_cast<void>(encode_json(*result));  // asserts the ranges of what came out
  }
}

TEST(JsonDecode, Decode_LeftOutMembers_HaveTheirDefaults) {
  const auto result = decode_json(
      R"({"type":"frames","frames":[{"viseme":{"select1":10}},{"time":40,"expression":{"select1":1}},{"faps":{"3":200}}]})");
  ASSERT_TRUE(result.ok()) << result.error().message;
  const auto& frames = std::get<Frames>(*result).frames;
  EXPECT_EQ(frames[0].state.viseme, (VisemeBlend{10, 0, 63}));
  EXPECT_EQ(frames[1].state.viseme, VisemeBlend{});  // a frame is the whole state
  EXPECT_EQ(frames[1].state.expression, (ExpressionBlend{1, 63, 0, 0}));
  EXPECT_EQ(frames[2].time, 40U);
  EXPECT_EQ(frames[2].state.level[3], 50);
}

TEST(JsonDecode, Decode_UnknownMembers_AreSkipped) {
  EXPECT_TRUE(decode_json(R"({"type":"end","reason":"finished","later":[1,{"x":2}]})").ok());
  const auto unknown = decode_json(R"({"type":"end","reason":"bored"})");
  ASSERT_TRUE(unknown.ok());
  EXPECT_EQ(std::get<End>(*unknown).reason, EndReason::other);
}

TEST(JsonCodec, RoundTrip_OneOfEachMessage) {
  for (const Message& message : one_of_each()) {
    const auto result = decode_json(encode_json(message));
    ASSERT_TRUE(result.ok()) << result.error().where << " " << result.error().message;
    EXPECT_EQ(*result, message);
  }
}

TEST(JsonCodec, Encode_ByHand) {
  FaceFrame state;
  state.level[3] = 50;   // step 4
  state.level[48] = -3;  // step 170
  EXPECT_EQ(encode_json(Keyframe{9, 200, state}),
            R"({"type":"keyframe","sequence":9,"media_time":200,"state":{"viseme":{"select1":0,"select2":0,"blend":0},)"
            R"("expression":{"select1":0,"intensity1":0,"select2":0,"intensity2":0},"faps":{"3":200,"48":-510}}})");
}

TEST(JsonCodec, RoundTrip_FinerSteps_UsesTheStreams) {
  Header header;
  header.quantizers.assign(66, 0.25);
  const QuantizerSteps steps = quantizers_of(header);
  const auto result = decode_json(R"({"type":"keyframe","state":{"faps":{"3":10.26}}})", steps);
  ASSERT_TRUE(result.ok());
  EXPECT_EQ(std::get<Keyframe>(*result).state.level[3], 41);  // 10.26 / 0.25 = 41.04
  EXPECT_NE(encode_json(*result, steps).find("\"3\":10.25"), std::string::npos);
}

TEST(JsonFrames, Decode_BodyOfARequest) {
  const auto frames = decode_json_frames(R"({"frames":[{"faps":{"3":200}},{"time":40}]})");
  ASSERT_TRUE(frames.ok()) << frames.error().message;
  EXPECT_EQ((*frames)[0].state.level[3], 50);
  EXPECT_EQ((*frames)[1].time, 40U);
  const auto wrong = decode_json_frames(R"({"frames":[{"faps":{"99":200}}]})");
  ASSERT_FALSE(wrong.ok());
  EXPECT_EQ(wrong.error().where, "/frames/0/faps/99");
  ASSERT_FALSE(decode_json_frames("{}").ok());
}

TEST(Quantize, Quantize_RoundsHalvesAwayFromZero) {
  EXPECT_EQ(*quantize(2.0, 4.0), 1);  // 0.5 -> 1
  EXPECT_EQ(*quantize(-2.0, 4.0), -1);
  EXPECT_EQ(*quantize(1.9, 4.0), 0);
  EXPECT_EQ(*quantize(32767.4, 1.0), 32767);
  EXPECT_EQ(quantize(32767.5, 1.0).error().code, ErrorCode::out_of_range);
  EXPECT_EQ(quantize(std::numeric_limits<double>::quiet_NaN(), 1.0).error().code, ErrorCode::not_finite);
  EXPECT_EQ(quantize(std::numeric_limits<double>::infinity(), 1.0).error().code, ErrorCode::not_finite);
}

}  // namespace
}  // namespace semblante
