#include "protocol/cpp/packed_codec.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <random>

#include <gtest/gtest.h>

#include "core/performance/performance.h"
#include "protocol/cpp/face_frame.h"
#include "protocol/cpp/fap_file_frames.h"
#include "protocol/cpp/frame_codec.h"
#include "protocol/cpp/kernel_values.h"
#include "protocol/cpp/performance_document.h"
#include "tests/unit/protocol/messages_for_tests.h"

namespace semblante {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// Batches of `per_message` frames that follow a keyframe of number `sequence`.
std::vector<Frames> batches(const std::vector<TimedFrame>& talk, std::size_t per_message, std::uint64_t sequence = 0) {
  std::vector<Frames> messages;
  for (std::size_t i = 0; i < talk.size(); i += per_message) {
    Frames batch{sequence + i + 1, talk[i].time, {}};
    for (std::size_t k = i; k < std::min(i + per_message, talk.size()); ++k) {
      batch.frames.push_back({talk[k].time - talk[i].time, talk[k].state});
    }
    messages.push_back(std::move(batch));
  }
  return messages;
}

void expect_same(FrameDecoder& decoder, const Bytes& bytes, const Message& message) {
  const auto result = decoder.decode(bytes);
  ASSERT_TRUE(result.ok()) << result.error().where << " " << result.error().message;
  ASSERT_EQ(*result, message);
}

TEST(PackedCodec, RoundTrip_LongTalk_IsLossless) {
  PackedEncoder encoder;
  FrameDecoder decoder;
  expect_same(decoder, encoder.keyframe(), Keyframe{});
  for (const Frames& batch : batches(talking_face(5000), 5)) {
    ASSERT_NO_FATAL_FAILURE(expect_same(decoder, encoder.encode(batch), batch));
  }
}

TEST(PackedCodec, RoundTrip_LevelLimits) {
  FaceFrame low;
  FaceFrame high;
  for (std::size_t fap = 3; fap <= 68; ++fap) {
    low.level[fap] = -32767;
    high.level[fap] = fap % 2 == 0 ? std::int16_t{32767} : std::int16_t{1};
  }
  PackedEncoder encoder(Keyframe{1, 0, low});
  FrameDecoder decoder;
  expect_same(decoder, encoder.keyframe(), Keyframe{1, 0, low});
  Frames batch{2, 0, {}};
  std::mt19937 random(2);
  for (int i = 0; i < 1024; ++i) {
    TimedFrame frame;
    frame.state = random() % 2 == 0 ? low : high;
    for (std::size_t fap = 3; fap <= 68; ++fap) {
      if (random() % 3 == 0) frame.state.level[fap] = random() % 2 == 0 ? std::int16_t{32767} : std::int16_t{0};
    }
    batch.frames.push_back(frame);
  }
  expect_same(decoder, encoder.encode(batch), batch);
}

TEST(PackedCodec, RoundTrip_EveryPairOfVisemesAndExpressions) {
  PackedEncoder encoder;
  FrameDecoder decoder;
  expect_same(decoder, encoder.keyframe(), Keyframe{});
  std::mt19937 random(7);
  Frames batch{1, 0, {}};
  for (std::uint64_t round = 0; round < 300; ++round) {
    batch.frames.clear();
    for (int i = 0; i < 20; ++i) {
      TimedFrame frame;
      const auto below = [&](unsigned count) { return static_cast<std::uint8_t>(random() % count); };
      frame.state.viseme = {below(round % 2 == 0 ? 15 : 3), below(round % 2 == 0 ? 15 : 3), below(64)};
      if (random() % 3 == 0) frame.state.viseme.blend = 63;
      frame.state.expression = {below(round % 3 == 0 ? 7 : 2), below(64), below(round % 3 == 0 ? 7 : 2), below(64)};
      batch.frames.push_back(frame);
    }
    ASSERT_NO_FATAL_FAILURE(expect_same(decoder, encoder.encode(batch), batch));
    batch.sequence += batch.frames.size();
  }
}

TEST(PackedCodec, RoundTrip_AnyTimes) {
  PackedEncoder encoder(Keyframe{5, max_media_time, {}});
  FrameDecoder decoder;
  expect_same(decoder, encoder.keyframe(), Keyframe{5, max_media_time, {}});
  std::uint64_t sequence = 6;
  const std::uint64_t bases[] = {0, max_media_time, max_media_time, 0, 0, 40, 80, 79, 1, std::uint64_t{1} << 52U,
                                 0, 86'400'001};
  const std::vector<std::vector<std::uint32_t>> times = {
      {0}, {0, 0, 0}, {86'400'000}, {0, 33, 67, 100, 133}, {5, 5, 86'399'999, 86'400'000}, {0, 40, 80}};
  for (const std::uint64_t base : bases) {
    for (const auto& each : times) {
      Frames batch{sequence, base, {}};
      for (const std::uint32_t time : each) batch.frames.push_back({time, {}});
      sequence += each.size();
      ASSERT_NO_FATAL_FAILURE(expect_same(decoder, encoder.encode(batch), batch)) << base;
      // Who joins here reads on as well.
      FrameDecoder late;
      ASSERT_TRUE(late.decode(encoder.keyframe()).ok());
    }
  }
}

TEST(PackedCodec, Encode_SequenceZero_IsTheNextFrame) {
  PackedEncoder encoder(Keyframe{200, 0, {}});
  PackedEncoder other = encoder;
  EXPECT_EQ(encoder.encode(Frames{0, 40, {{0, {}}}}), other.encode(Frames{201, 40, {{0, {}}}}));
  EXPECT_EQ(encoder.sequence(), 201U);
  EXPECT_EQ(encoder.media_time(), 40U);
}

TEST(PackedCodec, Keyframe_Anywhere_LetsItsReaderGoOnWithTheSameBytes) {
  const auto talk = talking_face(400, 4);
  PackedEncoder encoder(Keyframe{1000, 0, {}});
  std::vector<FrameDecoder> readers;
  for (const Frames& batch : batches(talk, 3, 1000)) {
    FrameDecoder& late = readers.emplace_back();
    const Keyframe here{encoder.sequence(), encoder.media_time(), encoder.state()};
    ASSERT_NO_FATAL_FAILURE(expect_same(late, encoder.keyframe(), here));
    const PackedEncoder copy = encoder;
    const Bytes bytes = encoder.encode(batch);
    EXPECT_EQ(PackedEncoder(copy).encode(batch), bytes) << "a copy goes on alike";
    for (FrameDecoder& reader : readers) ASSERT_NO_FATAL_FAILURE(expect_same(reader, bytes, batch));
  }
}

std::string file_text(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  EXPECT_TRUE(file) << path;
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Bytes of a stream of these frames: the first a keyframe, then five a message.
std::size_t stream_bytes(const std::vector<TimedFrame>& frames) {
  PackedEncoder encoder(Keyframe{1, frames[0].time, frames[0].state});
  std::size_t bytes = encoder.keyframe().size();
  for (const Frames& batch : batches({frames.begin() + 1, frames.end()}, 5, 1)) bytes += encoder.encode(batch).size();
  return bytes;
}

TEST(PackedCodec, Encode_TalkingMinute_TakesLessThanAKilobitASecond) {
  const auto script =
      read_performance(file_text(std::string(SEMBLANTE_SOURCE_DIR) + "/protocol/examples/performances/minute.json"));
  ASSERT_TRUE(script.ok());
  const auto performance = Performance::compile(*script);
  ASSERT_TRUE(performance.ok());
  std::vector<TimedFrame> frames;
  for (std::uint32_t time = 0; time < 60'000; time += 40) {
    frames.push_back({time, quantized(performance->frame_at(time))});
  }
  // 0.49 kbit/s when this was written; more is a regression of the coding (or another minute).
  EXPECT_LT(stream_bytes(frames), 0.52 * 1000 / 8 * 60);
}

TEST(PackedCodec, Encode_Samples_TakeLessThanTwoKilobitsASecond) {
  const char* folder = std::getenv("SEMBLANTE_SAMPLES_DIR");
  if (folder == nullptr || !std::ifstream(std::string(folder) + "/joy.fap")) GTEST_SKIP() << "no samples";
  const std::pair<const char*, double> most[] = {{"joy", 1.35}, {"anger", 1.37}, {"fear", 1.53}};  // kbit/s
  for (const auto& [name, kilobits] : most) {
    const auto file = read_fap_file(file_text(std::string(folder) + "/" + name + ".fap"));
    ASSERT_TRUE(file.ok());
    const auto values = frames_of(file->file);
    ASSERT_TRUE(values.ok());
    std::vector<TimedFrame> frames;
    for (const TimedValues& each : *values) frames.push_back({each.time, to_frame(each.state)});
    EXPECT_LT(static_cast<double>(stream_bytes(frames)),
              kilobits * 1000 / 8 * 0.04 * static_cast<double>(frames.size()))
        << name;
  }
}

TEST(PackedCodec, Keyframe_OfTheNeutralFace_IsTiny) { EXPECT_LE(PackedEncoder().keyframe().size(), 4U); }

TEST(PackedCodec, Encode_NothingChanges_TakesNextToNothing) {
  PackedEncoder encoder;
  Frames batch{1, 40, {}};
  for (std::uint32_t i = 0; i < 5; ++i) batch.frames.push_back({40 * i, {}});
  std::size_t bytes = 0;
  for (int i = 0; i < 100; ++i) {
    bytes += encoder.encode(batch).size();
    batch.sequence += 5;
    batch.media_time += 200;
  }
  EXPECT_LE(bytes, 250U) << "500 frames";
}

TEST(PackedCodec, Decode_FramesBeforeAKeyframe_OrASecondTime_AreRefused) {
  PackedEncoder encoder;
  FrameDecoder decoder;
  const auto expect_mismatch = [&](const Bytes& bytes) {
    const auto result = decoder.decode(bytes);
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(result.error().code, ErrorCode::mismatch);
    EXPECT_EQ(result.error().where, "/sequence");
  };
  const Bytes start = encoder.keyframe();
  const Bytes batch = encoder.encode(Frames{1, 40, {{0, {}}}});
  expect_mismatch(batch);
  ASSERT_TRUE(decoder.decode(start).ok());
  ASSERT_TRUE(decoder.decode(batch).ok());
  expect_mismatch(batch);  // after frame 1 comes 2
  decoder.reset();
  expect_mismatch(batch);
}

TEST(PackedCodec, Decode_SequenceNumbersBeyondTheLast_AreRefused) {
  PackedEncoder encoder(Keyframe{max_media_time - 1, 0, {}});
  FrameDecoder reader;
  ASSERT_TRUE(reader.decode(encoder.keyframe()));
  const auto refused = reader.decode(PackedEncoder(encoder).encode(Frames{0, 40, {{0, {}}, {40, {}}}}));
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::out_of_range);
  EXPECT_EQ(refused.error().where, "/sequence");
  EXPECT_TRUE(reader.decode(encoder.encode(Frames{0, 40, {{0, {}}}}))) << "the last number of all";
  FrameDecoder late;
  EXPECT_TRUE(late.decode(encoder.keyframe()));
}

TEST(PackedCodec, Decode_AfterAnError_GoesOnFromTheLastGoodState) {
  const auto messages = batches(talking_face(9), 3);
  PackedEncoder encoder;
  FrameDecoder decoder;
  ASSERT_TRUE(decoder.decode(encoder.keyframe()).ok());
  for (const Frames& batch : messages) {
    const Bytes good = encoder.encode(batch);
    ASSERT_FALSE(decoder.decode(std::span(good).first(good.size() / 2)).ok());
    ASSERT_NO_FATAL_FAILURE(expect_same(decoder, good, batch));
  }
}

TEST(PackedCodec, Decode_BytesAfterTheEnd_AreRefused) {
  PackedEncoder encoder;
  FrameDecoder decoder;
  Bytes keyframe = encoder.keyframe();
  keyframe.insert(keyframe.end(), 5, 0);
  const auto refused = decoder.decode(keyframe);
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().code, ErrorCode::malformed);
  ASSERT_TRUE(decoder.decode(encoder.keyframe()).ok());
  Bytes bytes = encoder.encode(Frames{1, 40, {{0, talking_face(3).back().state}}});
  bytes.insert(bytes.end(), 5, 1);
  EXPECT_FALSE(decoder.decode(bytes).ok());
}

/// One keyframe at the beginning, one in the middle, and batches.
struct Stream {
  std::vector<Bytes> messages;
  std::vector<FrameDecoder> before;  ///< a reader of all before each message
};
Stream a_stream() {
  Stream stream;
  FrameDecoder reader;
  const auto take = [&](const Bytes& bytes) {
    stream.messages.push_back(bytes);
    stream.before.push_back(reader);
    ASSERT_TRUE(reader.decode(bytes).ok());
  };
  const auto talk = talking_face(40, 6);
  PackedEncoder encoder(Keyframe{40, 1000, talk.back().state});
  take(encoder.keyframe());
  int number = 0;
  for (const Frames& batch : batches(talk, 4, 40)) {
    take(encoder.encode(batch));
    if (++number % 4 == 0) take(encoder.keyframe());
  }
  return stream;
}

/// Whatever comes out of the decoder is within the documented ranges: the encoder, which asserts them, takes it.
void expect_refused_or_valid(FrameDecoder decoder, std::span<const std::uint8_t> bytes) {
  const auto result = decoder.decode(bytes);
  if (!result) return;
  if (const auto* frames = std::get_if<Frames>(&*result)) {
    ASSERT_FALSE(frames->frames.empty());
    ASSERT_LE(frames->frames.size(), max_frames_per_message);
    ASSERT_LE(frames->media_time, max_media_time);
    std::uint32_t time = 0;
    for (const auto& frame : frames->frames) {
      ASSERT_TRUE(is_valid(frame.state));
      ASSERT_GE(frame.time, time);
      ASSERT_LE(frame.time, max_frame_time);
      time = frame.time;
    }
  }
  if (const auto* keyframe = std::get_if<Keyframe>(&*result)) {
    ASSERT_TRUE(is_valid(keyframe->state));
  }
}

TEST(PackedCodec, Decode_EveryPrefix_IsRefusedOrValid) {
  const Stream stream = a_stream();
  std::size_t refused = 0;
  std::size_t prefixes = 0;
  for (std::size_t i = 0; i < stream.messages.size(); ++i) {
    const Bytes& good = stream.messages[i];
    prefixes += good.size();
    for (std::size_t size = 0; size < good.size(); ++size) {
      FrameDecoder decoder = stream.before[i];
      if (!decoder.decode(std::span(good).first(size))) ++refused;
      ASSERT_NO_FATAL_FAILURE(expect_refused_or_valid(stream.before[i], std::span(good).first(size)));
    }
  }
  // Not all: of the last four bytes any may be missing, since zeros are read in their place, which may say little.
  EXPECT_GE(10 * refused, 8 * prefixes);
}

TEST(PackedCodec, Decode_EveryFlippedBit_IsRefusedOrValid) {
  const Stream stream = a_stream();
  for (std::size_t i = 0; i < stream.messages.size(); ++i) {
    Bytes bytes = stream.messages[i];
    for (std::size_t bit = 0; bit < bytes.size() * 8; ++bit) {
      bytes[bit / 8] ^= static_cast<std::uint8_t>(1U << bit % 8);
      ASSERT_NO_FATAL_FAILURE(expect_refused_or_valid(stream.before[i], bytes));
      bytes[bit / 8] ^= static_cast<std::uint8_t>(1U << bit % 8);
    }
  }
}

TEST(PackedCodec, Decode_RandomBytes_IsRefusedOrValid) {
  std::mt19937 random(3);
  FrameDecoder decoder;
  ASSERT_TRUE(decoder.decode(PackedEncoder().keyframe()).ok());
  for (int round = 0; round < 3000; ++round) {
    Bytes bytes(1 + random() % 60);
    for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random() % 4 == 0 ? random() : random() % 2 * 255);
    bytes[0] = random() % 3 == 0 ? 9 : 0x81;
    ASSERT_NO_FATAL_FAILURE(expect_refused_or_valid(decoder, bytes));
  }
}

}  // namespace
}  // namespace semblante
