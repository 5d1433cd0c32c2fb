#include "protocol/cpp/frame_codec.h"

#include <random>

#include <gtest/gtest.h>

#include "protocol/cpp/face_frame.h"
#include "tests/support/frame_encoder.h"
#include "tests/unit/protocol/messages_for_tests.h"

namespace semblante {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// Of these packed_codec_test.cpp knows more.
bool has_a_face(const Message& message) {
  return std::holds_alternative<Keyframe>(message) || std::holds_alternative<Frames>(message);
}

FrameDecoder decoder_after_neutral_keyframe() {
  FrameDecoder decoder;
  EXPECT_TRUE(decoder.decode(FrameEncoder().encode(Keyframe{})).ok());
  return decoder;
}

void expect_refused(const Bytes& bytes, ErrorCode code, std::string_view where) {
  FrameDecoder decoder = decoder_after_neutral_keyframe();
  const auto result = decoder.decode(bytes);
  ASSERT_FALSE(result.ok()) << where;
  EXPECT_EQ(result.error().code, code) << where << ": " << result.error().message;
  EXPECT_EQ(result.error().where, where) << result.error().message;
}

TEST(FrameDecoder, Decode_InvalidMessages_AreRefusedByField) {
  expect_refused({}, ErrorCode::truncated, "/type");
  expect_refused({0}, ErrorCode::unsupported, "/type");
  expect_refused({127}, ErrorCode::unsupported, "/type");
  expect_refused({3, 0, 0, 0}, ErrorCode::unsupported, "/type");
  expect_refused(Bytes(262145, 3), ErrorCode::too_large, "");
  // hello: version, role, resume?
  expect_refused({1}, ErrorCode::truncated, "/version");
  expect_refused({1, 0x80}, ErrorCode::truncated, "/version");
  expect_refused({1, 0x80, 0x80, 0x04, 0, 0}, ErrorCode::out_of_range, "/version");  // 65536
  expect_refused({1, 1, 2, 0}, ErrorCode::out_of_range, "/role");
  expect_refused({1, 1, 0, 2}, ErrorCode::malformed, "/resume");
  expect_refused({1, 1, 0, 1, 5}, ErrorCode::truncated, "/resume/sequence");
  // a varint of 11 bytes, and one of 10 bytes that needs 65 bits
  expect_refused({1, 1, 0, 1, 255, 255, 255, 255, 255, 255, 255, 255, 255, 255, 1}, ErrorCode::truncated,
                 "/resume/epoch");
  expect_refused({1, 1, 0, 1, 255, 255, 255, 255, 255, 255, 255, 255, 255, 2, 1}, ErrorCode::truncated,
                 "/resume/epoch");
  // 2^53 is one too many
  expect_refused({1, 1, 0, 1, 128, 128, 128, 128, 128, 128, 128, 16, 1}, ErrorCode::out_of_range, "/resume/epoch");
  // error: a text that is not UTF-8, one longer than its field, one longer than the message
  expect_refused({6, 1, 1, 0xFF, 0}, ErrorCode::malformed, "/where");
  expect_refused({6, 1, 0x81, 0x08}, ErrorCode::too_large, "/where");
  expect_refused({6, 1, 5, 'a'}, ErrorCode::truncated, "/where");
  // ping: time is not a number, is infinite
  expect_refused({7, 1, 0, 0, 0, 0, 0, 0, 0xF8, 0x7F}, ErrorCode::not_finite, "/client_time");
  expect_refused({7, 1, 0, 0, 0, 0, 0, 0, 0xF0, 0xFF}, ErrorCode::not_finite, "/client_time");
}

TEST(FrameDecoder, Decode_BytesOfALaterVersion_AreSkipped) {
  FrameEncoder encoder;
  FrameDecoder decoder;
  for (const Message& message : one_of_each()) {
    if (has_a_face(message)) continue;
    Bytes bytes = encoder.encode(message);
    if (std::holds_alternative<Hello>(message)) bytes.insert(bytes.end(), 2, 0);  // its last fields are left out
    bytes.insert(bytes.end(), {1, 2, 3});
    const auto result = decoder.decode(bytes);
    ASSERT_TRUE(result.ok()) << result.error().message;
    EXPECT_EQ(*result, message);
  }
}

TEST(FrameDecoder, Decode_UnknownValueOfAnOpenEnumeration_IsOther) {
  FrameDecoder decoder;
  const auto result = decoder.decode(Bytes{5, 200});
  ASSERT_TRUE(result.ok());
  EXPECT_EQ(std::get<End>(*result).reason, EndReason::other);
}

TEST(FrameDecoder, Decode_EveryPrefix_IsRefusedAsTruncated) {
  FrameEncoder encoder;
  FrameDecoder decoder;
  for (const Message& message : one_of_each()) {
    if (has_a_face(message)) continue;
    const Bytes good = encoder.encode(message);
    // Appended fields may be missing as a whole: the header's share and sound take nine bytes each, those of hello one.
    std::size_t appended = 0;
    if (std::holds_alternative<Header>(message)) appended = 9;
    if (std::holds_alternative<Hello>(message)) appended = 1;
    for (std::size_t size = 0; size < good.size(); ++size) {
      if (size == good.size() - appended || size == good.size() - 2 * appended) continue;
      const auto result = decoder.decode(std::span(good).first(size));
      ASSERT_FALSE(result.ok()) << message.index() << " at " << size;
      ASSERT_EQ(result.error().code, ErrorCode::truncated) << message.index() << " at " << size;
    }
    ASSERT_TRUE(decoder.decode(good).ok());
  }
}

/// Whatever comes out of the decoder is within the documented ranges: the encoder, which asserts them, takes it.
void expect_valid(const Result<Message>& result) {
  if (!result) return;
  if (const auto* frames = std::get_if<Frames>(&*result)) {
    ASSERT_FALSE(frames->frames.empty());
    for (const auto& frame : frames->frames) ASSERT_TRUE(is_valid(frame.state));
  }
  if (const auto* keyframe = std::get_if<Keyframe>(&*result)) {
    ASSERT_TRUE(is_valid(keyframe->state));
  }
}

TEST(FrameDecoder, Decode_EveryFlippedBit_IsRefusedOrValid) {
  FrameEncoder encoder;
  FrameDecoder before;
  for (const Message& message : one_of_each()) {
    const Bytes good = encoder.encode(message);
    Bytes bytes = good;
    for (std::size_t bit = 0; bit < bytes.size() * 8; ++bit) {
      bytes[bit / 8] ^= static_cast<std::uint8_t>(1U << bit % 8);
      FrameDecoder decoder = before;
      expect_valid(decoder.decode(bytes));
      bytes[bit / 8] ^= static_cast<std::uint8_t>(1U << bit % 8);
    }
    ASSERT_TRUE(before.decode(good).ok());
  }
}

TEST(FrameDecoder, Decode_RandomBytes_IsRefusedOrValid) {
  std::mt19937 random(3);
  FrameDecoder decoder = decoder_after_neutral_keyframe();
  for (int round = 0; round < 20000; ++round) {
    Bytes bytes(1 + random() % 60);
    for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random() % 4 == 0 ? random() : random() % 8);
    expect_valid(decoder.decode(bytes));
  }
}

TEST(FrameDecoder, Decode_MessageOfAnEarlierWriter_LeavesTheAppendedFieldAbsent) {
  Header header = std::get<Header>(one_of_each()[1]);
  Bytes bytes = FrameEncoder().encode(header);
  header.sound.reset();
  EXPECT_EQ(FrameEncoder().encode(header), Bytes(bytes.begin(), bytes.end() - 9)) << "before there was sound";
  bytes.resize(bytes.size() - 18);
  const auto result = FrameDecoder().decode(bytes);
  ASSERT_TRUE(result.ok()) << result.error().where;
  header.viseme_share.reset();
  EXPECT_EQ(*result, Message(header));
  EXPECT_EQ(FrameEncoder().encode(header), bytes) << "written as an earlier writer does";
}

TEST(FrameCodec, RoundTrip_ShareOfZero_IsNotAbsent) {
  for (const double share : {0.0, 1.0}) {
    Header header;
    header.viseme_share = share;
    const auto result = FrameDecoder().decode(FrameEncoder().encode(header));
    ASSERT_TRUE(result.ok());
    EXPECT_EQ(std::get<Header>(*result).viseme_share, share);
  }
}

TEST(FrameCodec, RoundTrip_OneOfEachMessage) {
  FrameEncoder encoder;
  FrameDecoder decoder;
  for (const Message& message : one_of_each()) {
    const auto result = decoder.decode(encoder.encode(message));
    ASSERT_TRUE(result.ok()) << result.error().where << " " << result.error().message;
    EXPECT_EQ(*result, message);
  }
}

TEST(StreamErrors, FromError_KeepsWordsAndCutsLongOnes) {
  const StreamError error = to_stream_error({ErrorCode::out_of_range, "/a", std::string(4095, 'x') + "\xC3\xA9"});
  EXPECT_EQ(error.code, StreamErrorCode::out_of_range);
  EXPECT_EQ(error.where, "/a");
  EXPECT_EQ(error.message, std::string(4095, 'x'));
}

}  // namespace
}  // namespace semblante
