#include <fstream>
#include <zlib.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "protocol/cpp/byte_io.h"
#include "server/recordings/recording_reader.h"
#include "server/recordings/recording_writer.h"
#include "tests/support/varint_frames.h"
#include "tests/unit/recordings/recorded_frames.h"

namespace semblante::recordings {
namespace {

using ::testing::HasSubstr;

std::vector<RecordingFrame> all_frames(const RecordingReader& reader, std::uint32_t from = 0) {
  std::vector<RecordingFrame> frames;
  RecordingCursor cursor(std::make_shared<const RecordingReader>(reader), from);
  for (; cursor.frame() != nullptr; cursor.advance()) frames.push_back(*cursor.frame());
  EXPECT_FALSE(cursor.error()) << cursor.error()->message;
  return frames;
}

std::string hex(std::span<const std::uint8_t> bytes) {
  static constexpr std::string_view digits = "0123456789abcdef";
  std::string text;
  for (const auto byte : bytes) text.append({digits[byte >> 4U], digits[byte & 15U]});
  return text;
}

std::vector<std::uint8_t> bytes_of_hex(std::string_view text) {
  std::vector<std::uint8_t> bytes;
  for (std::size_t i = 0; i + 1 < text.size(); i += 2)
    bytes.push_back(static_cast<std::uint8_t>(std::stoul(std::string(text.substr(i, 2)), nullptr, 16)));
  return bytes;
}

Result<RecordingReader> open_memory(std::vector<std::uint8_t> bytes, Check check = Check::everything) {
  return RecordingReader::open(bytes_in_memory(std::move(bytes)), check);
}

/// A recording in memory with `each` frames in a chunk.
std::vector<std::uint8_t> in_chunks(const std::vector<RecordingFrame>& frames, std::size_t each) {
  auto bytes = encode_beginning(stream_header());
  for (std::size_t i = 0; i < frames.size(); i += each) {
    const auto chunk = encode_chunk(std::span(frames).subspan(i, std::min(each, frames.size() - i)), 0);
    bytes.insert(bytes.end(), chunk.begin(), chunk.end());
  }
  return bytes;
}

TEST(RecordingFile, WrittenInBatches_GivesTheSameFrames) {
  const Folder folder;
  const auto frames = random_frames(5000, 1);
  auto writer = RecordingWriter::create(folder.file("a.srec"), stream_header());
  ASSERT_TRUE(writer) << writer.error().message;
  std::size_t batches = 0;
  for (const auto& batch : in_batches(frames, 2)) {
    ASSERT_TRUE((*writer)->add(batch));
    if (++batches % 30 == 0) {
      ASSERT_TRUE((*writer)->flush());
    }
  }
  ASSERT_TRUE((*writer)->flush());
  EXPECT_EQ((*writer)->durable().frames, 5000U);
  EXPECT_EQ((*writer)->durable().sequence, 5041U);
  EXPECT_EQ((*writer)->durable().bytes, std::filesystem::file_size(folder.file("a.srec")));

  auto bytes = open_bytes(folder.file("a.srec"));
  ASSERT_TRUE(bytes);
  const auto reader = RecordingReader::open(*bytes, Check::everything);
  ASSERT_TRUE(reader) << reader.error().message;
  EXPECT_EQ(reader->header(), stream_header());
  EXPECT_EQ(reader->frames(), frames.size());
  EXPECT_EQ(reader->lost(), 0U);
  EXPECT_EQ(reader->begin(), frames.front().media_time);
  EXPECT_EQ(reader->duration(), frames.back().media_time - frames.front().media_time);
  EXPECT_EQ(reader->torn_bytes(), 0U);
  EXPECT_EQ(all_frames(*reader), frames);
}

TEST(RecordingFile, FramesThatNeverCame_AreAMarkedGap) {
  const Folder folder;
  const auto frames = random_frames(30, 3);
  auto writer = RecordingWriter::create(folder.file("a.srec"), stream_header());
  ASSERT_TRUE(writer);
  std::vector<RecordingFrame> kept;
  for (const auto& frame : frames) {
    if (frame.sequence >= 50 && frame.sequence < 57) continue;
    kept.push_back(frame);
    ASSERT_TRUE((*writer)->add(Frames{frame.sequence, frame.media_time, {{0, frame.state}}}));
  }
  ASSERT_TRUE((*writer)->flush());
  EXPECT_EQ((*writer)->durable().lost, 7U);
  const auto reader = open_memory(bytes_of(folder.file("a.srec")));
  ASSERT_TRUE(reader);
  EXPECT_EQ(reader->lost(), 7U);
  EXPECT_EQ(all_frames(*reader), kept);
}

TEST(RecordingFile, TimeThatFalls_StaysWithTheFrameBefore) {
  const Folder folder;
  auto writer = RecordingWriter::create(folder.file("a.srec"), stream_header());
  ASSERT_TRUE(writer);
  ASSERT_TRUE((*writer)->add(Frames{1, 100, {{0, {}}, {50, {}}}}));
  ASSERT_TRUE((*writer)->add(Frames{3, 120, {{0, {}}, {40, {}}}}));
  ASSERT_TRUE((*writer)->flush());
  const auto reader = open_memory(bytes_of(folder.file("a.srec")));
  ASSERT_TRUE(reader);
  std::vector<std::uint64_t> times;
  for (const auto& frame : all_frames(*reader)) times.push_back(frame.media_time);
  EXPECT_EQ(times, (std::vector<std::uint64_t>{100, 150, 150, 160}));
}

TEST(RecordingFile, LongerThanADay_IsRefused) {
  const Folder folder;
  auto writer = RecordingWriter::create(folder.file("a.srec"), stream_header());
  ASSERT_TRUE(writer);
  ASSERT_TRUE((*writer)->add(Frames{1, 100, {{0, {}}}}));
  EXPECT_EQ((*writer)->add(Frames{2, 101 + max_recording_ms, {{0, {}}}}).error().code, ErrorCode::out_of_range);
  ASSERT_TRUE((*writer)->flush());
  EXPECT_EQ((*writer)->durable().frames, 1U);
}

TEST(RecordingFile, FileThatIsThere_IsNotOverwritten) {
  const Folder folder;
  ASSERT_TRUE(RecordingWriter::create(folder.file("a.srec"), stream_header()));
  EXPECT_EQ(RecordingWriter::create(folder.file("a.srec"), stream_header()).error().code, ErrorCode::io);
  EXPECT_TRUE(std::filesystem::exists(folder.file("a.srec")));
}

TEST(RecordingFile, Seek_FindsWhatALinearSearchFinds) {
  const auto frames = random_frames(3000, 4);
  const std::uint64_t begin = frames.front().media_time;
  for (const std::size_t each : {1, 7, 1024}) {
    const auto reader = open_memory(in_chunks(frames, each), Check::heads);
    ASSERT_TRUE(reader);
    const auto shared = std::make_shared<const RecordingReader>(*reader);
    for (std::uint32_t ms = 0; ms < reader->duration() + 200; ms += each == 1 ? 997 : 211) {
      const RecordingFrame* expected = &frames.front();
      for (const auto& frame : frames)
        if (frame.media_time <= begin + ms) expected = &frame;
      const auto found = reader->at(ms);
      ASSERT_TRUE(found && *found);
      EXPECT_EQ(**found, *expected) << ms;
      const auto first = std::find_if(frames.begin(), frames.end(),
                                      [&](const RecordingFrame& frame) { return frame.media_time >= begin + ms; });
      const RecordingCursor cursor(shared, ms);
      ASSERT_EQ(cursor.frame() != nullptr, first != frames.end()) << ms;
      if (cursor.frame() != nullptr) {
        EXPECT_EQ(*cursor.frame(), *first) << ms;
      }
    }
  }
}

TEST(RecordingFile, MoreChunksThanTheIndexHolds_AreAllFound) {
  const auto frames = random_frames(3 * RecordingReader::max_index + 5, 5);
  const auto reader = open_memory(in_chunks(frames, 1), Check::heads);
  ASSERT_TRUE(reader);
  EXPECT_EQ(reader->frames(), frames.size());
  for (std::size_t i = 0; i < frames.size(); i += 501) {
    const auto ms = static_cast<std::uint32_t>(frames[i].media_time - frames.front().media_time);
    const auto found = reader->at(ms);
    ASSERT_TRUE(found && *found);
    EXPECT_EQ((*found)->media_time, frames[i].media_time);
  }
  EXPECT_EQ(all_frames(*reader), frames);
}

TEST(RecordingFile, WithoutFrames_IsEmpty) {
  const auto reader = open_memory(encode_beginning(stream_header()));
  ASSERT_TRUE(reader);
  EXPECT_EQ(reader->frames(), 0U);
  EXPECT_EQ(reader->duration(), 0U);
  const auto found = reader->at(0);
  ASSERT_TRUE(found);
  EXPECT_FALSE(*found);
  EXPECT_TRUE(all_frames(*reader).empty());
}

TEST(RecordingFile, EveryPrefix_IsReadUpToTheLastWholeChunk) {
  const auto frames = random_frames(40, 6);
  const auto bytes = in_chunks(frames, 8);
  const auto beginning = encode_beginning(stream_header()).size();
  std::size_t best = 0;
  for (std::size_t length = 0; length <= bytes.size(); ++length) {
    const auto reader = open_memory({bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(length)});
    ASSERT_EQ(static_cast<bool>(reader), length >= beginning) << length;
    if (!reader) {
      EXPECT_FALSE(reader.error().message.empty());
      continue;
    }
    EXPECT_LE(reader->whole_bytes(), length);
    EXPECT_EQ(reader->torn_bytes() == 0, reader->torn_reason().empty());
    EXPECT_EQ(reader->frames() % 8, 0U);
    EXPECT_GE(reader->frames(), best);
    best = reader->frames();
    const auto got = all_frames(*reader);
    EXPECT_TRUE(std::equal(got.begin(), got.end(), frames.begin()));
  }
  EXPECT_EQ(best, frames.size());
}

TEST(RecordingFile, EveryFlippedByte_IsNoticed) {
  const auto frames = random_frames(40, 7);
  const auto bytes = in_chunks(frames, 8);
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    for (const std::uint8_t flip : {0x01, 0x80, 0xFF}) {
      auto damaged = bytes;
      damaged[i] ^= flip;
      const auto whole = open_memory(damaged);
      if (whole) {
        EXPECT_LT(whole->frames(), frames.size()) << i;
        const auto got = all_frames(*whole);
        EXPECT_TRUE(std::equal(got.begin(), got.end(), frames.begin())) << i;
      }
      // By the heads alone damage is found when its chunk is read, and nothing wrong comes before.
      const auto quick = open_memory(damaged, Check::heads);
      if (!quick) continue;
      RecordingCursor cursor(std::make_shared<const RecordingReader>(*quick), 0);
      std::size_t right = 0;
      for (; cursor.frame() != nullptr; cursor.advance()) {
        ASSERT_LT(right, frames.size());
        EXPECT_EQ(*cursor.frame(), frames[right++]) << i;
      }
      EXPECT_TRUE(cursor.error() || quick->torn_bytes() > 0) << i;
    }
  }
}

TEST(RecordingFile, TornTail_IsCutOff_AndWritingWentOnBeforeIt) {
  const Folder folder;
  const auto frames = random_frames(40, 8);
  const auto bytes = in_chunks(frames, 8);
  for (const std::size_t lost : {1, 30, 47, 48, 200}) {
    const auto path = folder.file("torn.srec");
    std::ofstream(path, std::ios::binary | std::ios::trunc)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size() - lost));
    const auto progress = repair_recording(path);
    ASSERT_TRUE(progress) << progress.error().message;
    EXPECT_EQ(progress->frames, 32U);
    EXPECT_EQ(progress->sequence, 73U);
    EXPECT_EQ(progress->bytes, std::filesystem::file_size(path));
    const auto reader = open_memory(bytes_of(path));
    ASSERT_TRUE(reader);
    EXPECT_EQ(reader->torn_bytes(), 0U);
    EXPECT_EQ(repair_recording(path).value(), *progress) << "a second time changes nothing";
  }
}

TEST(RecordingFile, DamageInTheMiddle_IsNotCutOff) {
  const Folder folder;
  auto bytes = in_chunks(random_frames(30'000, 9), 200);
  ASSERT_GT(bytes.size(), 2U * max_chunk_bytes);
  bytes[2000] ^= 1U;
  const auto path = folder.file("damaged.srec");
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  const auto repaired = repair_recording(path);
  ASSERT_FALSE(repaired);
  EXPECT_EQ(repaired.error().code, ErrorCode::mismatch);
  EXPECT_EQ(bytes_of(path), bytes);
}

TEST(RecordingFile, OtherFiles_AreRefusedByName) {
  EXPECT_THAT(open_memory({'2', '.', '1', ' ', 'a', ' ', '2', '5', ' '}).error().message, HasSubstr("not a recording"));
  auto later = encode_beginning(stream_header());
  later[7] = 3;
  EXPECT_EQ(open_memory(later).error().code, ErrorCode::unsupported);
  later[7] = 0;
  EXPECT_EQ(open_memory(later).error().code, ErrorCode::unsupported);
}

TEST(RecordingFile, ChunkOfAKindOfLater_IsSkipped) {
  const auto frames = random_frames(16, 10);
  auto bytes = in_chunks({frames.begin(), frames.begin() + 8}, 8);
  std::vector<std::uint8_t> later(chunk_head_bytes + 3);
  std::copy(chunk_magic.begin(), chunk_magic.end(), later.begin());
  later[4] = 3;
  later[12] = 9;
  byte_io::put_u32(&later[8], static_cast<std::uint32_t>(crc32_z(0, &later[12], later.size() - 12)));
  bytes.insert(bytes.end(), later.begin(), later.end());
  const auto rest = encode_chunk(std::span(frames).subspan(8), 0);
  bytes.insert(bytes.end(), rest.begin(), rest.end());
  const auto reader = open_memory(bytes);
  ASSERT_TRUE(reader);
  EXPECT_EQ(all_frames(*reader), frames);
}

/// What the file says of itself, byte by byte, for whoever reads it without this program.
TEST(RecordingFile, Golden) {
  FaceFrame smile;
  smile.viseme = {1, 2, 30};
  smile.level[12] = 5;
  FaceFrame more = smile;
  more.level[12] = 7;
  const auto chunk = encode_chunk(std::vector<RecordingFrame>{{42, 5000, smile}, {43, 5040, more}}, 3);
  EXPECT_EQ(hex(chunk),
            "43484e4b"          // CHNK
            "1b000000"          // 27 bytes of messages
            "1382f534"          // CRC-32 from here on to the end
            "02000000"          // frames
            "02000000"          // two
            "03000000"          // three were lost before
            "2a00000000000000"  // number 42
            "8813000000000000"  // from 5000 ms
            "b013000000000000"  // to 5040 ms
            "0d"                // a keyframe of 13 bytes
            "092a8827bcffb0f772972540a1"
            "0c"  // frames of 12 bytes
            "ab0373039aaa48be514d6d68");
  const auto read = read_frames_chunk(chunk);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->back(), (RecordingFrame{43, 5040, more}));
}

/// The same two frames as the program wrote them before version 2.
TEST(RecordingFile, GoldenOfVersion1_IsStillRead) {
  FaceFrame more;
  more.viseme = {1, 2, 30};
  more.level[12] = 7;
  const auto read =
      read_frames_chunk(bytes_of_hex("43484e4b"          // CHNK
                                     "17000000"          // 23 bytes of messages
                                     "b591f4ed"          // CRC-32 from here on to the end
                                     "02000000"          // frames
                                     "02000000"          // two
                                     "03000000"          // three were lost before
                                     "2a00000000000000"  // number 42
                                     "8813000000000000"  // from 5000 ms
                                     "b013000000000000"  // to 5040 ms
                                     "0b"                // a keyframe of 11 bytes
                                     "032a88270501021e80040a"
                                     "0a"  // frames of 10 bytes
                                     "042b8827012804800404"));
  ASSERT_TRUE(read) << read.error().message;
  ASSERT_EQ(read->size(), 2U);
  EXPECT_EQ(read->back(), (RecordingFrame{43, 5040, more}));
  more.level[12] = 5;
  EXPECT_EQ(read->front(), (RecordingFrame{42, 5000, more}));
}

/// The messages of a chunk with a head and a checksum of their own.
std::vector<std::uint8_t> version_1_chunk(const std::vector<RecordingFrame>& frames,
                                          const std::vector<std::vector<std::uint8_t>>& messages) {
  auto chunk = encode_chunk(frames, 0);
  chunk.resize(chunk_head_bytes);
  for (const auto& message : messages) {
    byte_io::append_varint(chunk, message.size());
    chunk.insert(chunk.end(), message.begin(), message.end());
  }
  byte_io::put_u32(&chunk[4], static_cast<std::uint32_t>(chunk.size() - chunk_head_bytes));
  byte_io::put_u32(&chunk[8], static_cast<std::uint32_t>(crc32_z(0, &chunk[12], chunk.size() - 12)));
  return chunk;
}

/// Keyframe and batch of these frames in the form of version 1.
std::vector<std::vector<std::uint8_t>> version_1_messages(const std::vector<RecordingFrame>& frames) {
  Frames rest{frames[0].sequence + 1, frames[0].media_time, {}};
  for (const auto& frame : std::span(frames).subspan(1))
    rest.frames.push_back({static_cast<std::uint32_t>(frame.media_time - frames[0].media_time), frame.state});
  return {testing::varint_keyframe({frames[0].sequence, frames[0].media_time, frames[0].state}),
          testing::varint_frames(rest, frames[0].state)};
}

TEST(RecordingFile, OfVersion1_IsReadWhole) {
  const auto frames = random_frames(3000, 11);
  auto bytes = encode_beginning(stream_header());
  bytes[7] = 1;
  for (std::size_t i = 0; i < frames.size(); i += 600) {
    const std::vector<RecordingFrame> part(frames.begin() + static_cast<std::ptrdiff_t>(i),
                                           frames.begin() + static_cast<std::ptrdiff_t>(i) + 600);
    const auto chunk = version_1_chunk(part, version_1_messages(part));
    bytes.insert(bytes.end(), chunk.begin(), chunk.end());
  }
  const auto reader = open_memory(bytes);
  ASSERT_TRUE(reader) << reader.error().message;
  EXPECT_EQ(reader->header(), stream_header());
  EXPECT_EQ(all_frames(*reader), frames);
}

TEST(RecordingFile, DamagedMessagesOfVersion1_AreRefusedOrValid) {
  const auto frames = random_frames(5, 12);
  const auto good = version_1_messages(frames);
  ASSERT_TRUE(read_frames_chunk(version_1_chunk(frames, good)));
  for (std::size_t message = 0; message < good.size(); ++message) {
    for (std::size_t size = 0; size < good[message].size(); ++size) {
      auto cut = good;
      cut[message].resize(size);
      EXPECT_FALSE(read_frames_chunk(version_1_chunk(frames, cut))) << message << " at " << size;
    }
    for (std::size_t bit = 0; bit < 8 * good[message].size(); ++bit) {
      auto flipped = good;
      flipped[message][bit / 8] ^= static_cast<std::uint8_t>(1U << bit % 8);
      const auto read = read_frames_chunk(version_1_chunk(frames, flipped));
      for (std::size_t i = 0; read && i < read->size(); ++i) EXPECT_TRUE(is_valid((*read)[i].state)) << bit;
    }
  }
}

TEST(RecordingFile, ImpossibleMessagesOfVersion1_AreRefused) {
  const std::vector<RecordingFrame> two = {{1, 0, {}}, {2, 40, {}}};
  const std::vector<std::uint8_t> key = {3, 1, 0, 0};
  const std::vector<std::vector<std::uint8_t>> keys = {{3, 1, 0, 0x80, 0x10},               // bit 11 of a state
                                                       {3, 1, 0, 1, 15, 0, 0},              // viseme 15
                                                       {3, 1, 0, 2, 0, 64, 0, 0},           // an intensity of 64
                                                       {3, 1, 0, 4, 0},                     // an empty mask
                                                       {3, 1, 0, 0x80, 8, 0x10, 2},         // a mask beyond its group
                                                       {3, 1, 0, 4, 1, 0x80, 0x80, 0x04},   // a level of 32768
                                                       {3, 1, 0, 4, 2, 0xFF, 0xFF, 0x03}};  // one of -32768
  for (const auto& each : keys) EXPECT_FALSE(read_frames_chunk(version_1_chunk({two[0]}, {each}))) << hex(each);
  const std::vector<std::vector<std::uint8_t>> batches = {
      {4, 2, 0, 0},                             // no frames
      {4, 2, 0, 0x81, 0x08},                    // 1025 frames
      {4, 2, 0, 1, 0x81, 0xB8, 0x99, 0x29, 0},  // a day and 1 ms later
      {3, 2, 0, 0}};                            // a keyframe in place of frames
  for (const auto& each : batches) EXPECT_FALSE(read_frames_chunk(version_1_chunk(two, {key, each}))) << hex(each);
  EXPECT_TRUE(read_frames_chunk(version_1_chunk(two, {key, {4, 2, 0, 1, 40, 0}})));

  // The second time is 2^64 - 1 ms after the first: a sum without a check would be 1 ms before it.
  const std::vector<RecordingFrame> three = {{1, 0, {}}, {2, 5, {}}, {3, 5, {}}};
  const std::vector<std::uint8_t> back = {4,    2,    0,    2,    5,    0,    0xFF, 0xFF, 0xFF,
                                          0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0x01, 0};
  const auto read = read_frames_chunk(version_1_chunk(three, {key, back}));
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().message, "a frame is more than a day after its message");
}

}  // namespace
}  // namespace semblante::recordings
